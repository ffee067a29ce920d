#include "app/plot_io.h"

#include "renderer/core/file_io.h"
#include "renderer/core/image_io.h"

#include <span>

namespace patina {

std::vector<std::filesystem::path> save_plot(const std::filesystem::path& stem, const Plot& plot) {
    std::vector<std::filesystem::path> files{stem, stem};
    files[0] += ".svg";
    files[1] += ".png";
    const std::string svg = plot_to_svg(plot);
    write_file(files[0], std::as_bytes(std::span(svg)));
    save_image(files[1], plot_to_image(plot));
    return files;
}

}  // namespace patina
