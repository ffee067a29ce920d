#include "renderer/core/image_io.h"

#include "renderer/core/file_io.h"
#include "renderer/core/image_format.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <optional>
#include <stdexcept>

namespace patina {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file, const std::string& what) {
    throw std::runtime_error(path_text(file) + ": " + what);
}

/// Once a process: no thread pools of the library's own, no plug-ins from elsewhere.
void configure_library() {
    static const bool done = [] {
        OIIO::attribute("threads", 1);
        OIIO::attribute("exr_threads", -1);
        OIIO::attribute("plugin_searchpath", "");
        return true;
    }();
    static_cast<void>(done);
}

/// The library's own words, on one line, without its "file" prefix.
std::string one_line(std::string text) {
    const std::size_t end = text.find_last_not_of(" \n\r\t.");
    text.resize(end == std::string::npos ? 0 : end + 1);
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

PixelType pixel_type_of(const OIIO::TypeDesc& format) {
    switch (format.basetype) {
        case OIIO::TypeDesc::UINT8:
            return PixelType::U8;
        case OIIO::TypeDesc::UINT16:
            return PixelType::U16;
        default:
            return PixelType::F32;
    }
}

OIIO::TypeDesc type_desc_of(PixelType type) {
    switch (type) {
        case PixelType::U8:
            return OIIO::TypeDesc::UINT8;
        case PixelType::U16:
            return OIIO::TypeDesc::UINT16;
        case PixelType::F32:
            break;
    }
    return OIIO::TypeDesc::FLOAT;
}

/// An open decoder over bytes in memory.
struct Decoder {
    std::unique_ptr<OIIO::Filesystem::IOMemReader> memory;
    std::unique_ptr<OIIO::ImageInput> input;
    OIIO::ImageSpec spec;
};

ImageFormat known_format(const fs::path& file, std::span<const std::byte> bytes) {
    if (bytes.empty()) fail(file, "is empty; copy or export it again");
    const ImageFormat format = image_format_of(bytes);
    if (format == ImageFormat::Unknown)
        fail(file, "is not a PNG, JPEG, TIFF, TGA, BMP, EXR or HDR picture; convert it to one of these");
    return format;
}

Decoder open_decoder(const fs::path& file, ImageFormat format, std::span<const std::byte> bytes) {
    configure_library();
    Decoder decoder;
    decoder.memory = std::make_unique<OIIO::Filesystem::IOMemReader>(bytes.data(), bytes.size());
    decoder.input =
        OIIO::ImageInput::create(std::string(image_format_id(format)), false, nullptr, decoder.memory.get());
    if (!decoder.input)
        fail(file, "cannot be decoded by the installed OpenImageIO (" + one_line(OIIO::geterror()) + ")");
    OIIO::ImageSpec config;
    config["oiio:UnassociatedAlpha"] = 1;
    OIIO::Filesystem::IOProxy* proxy = decoder.memory.get();
    config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    const std::string name = "picture." + std::string(image_format_id(format));
    if (!decoder.input->open(name, decoder.spec, config))
        fail(file, "is damaged (" + one_line(decoder.input->geterror()) + "); copy or export it again");
    return decoder;
}

void check_size(const fs::path& file, const OIIO::ImageSpec& spec) {
    const std::int64_t pixels = static_cast<std::int64_t>(spec.width) * spec.height;
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1) fail(file, "has no pixels; export it again");
    if (spec.width > kMaxImageSide || spec.height > kMaxImageSide || pixels > kMaxImagePixels)
        fail(file, "promises " + std::to_string(spec.width) + "×" + std::to_string(spec.height) +
                       " pixels, more than Patina reads (16384×16384); scale it down");
    if (spec.deep) fail(file, "holds deep data; flatten it");
    if (spec.depth > 1) fail(file, "is a volume; export one slice of it");
}

}  // namespace

ImageInfo load_image_info(const fs::path& file) {
    const std::vector<std::byte> bytes = read_file(file);
    const ImageFormat format = known_format(file, bytes);
    const Decoder decoder = open_decoder(file, format, bytes);
    check_size(file, decoder.spec);
    return {.width = decoder.spec.width,
            .height = decoder.spec.height,
            .channels = std::min(decoder.spec.nchannels, 4),
            .type = pixel_type_of(decoder.spec.format),
            .format = std::string(image_format_id(format))};
}

LoadedImage load_image(const fs::path& file) {
    const std::vector<std::byte> bytes = read_file(file);
    const ImageFormat format = known_format(file, bytes);
    if (const std::string problem = image_structure_problem(format, bytes); !problem.empty())
        fail(file, problem);
    const Decoder decoder = open_decoder(file, format, bytes);
    check_size(file, decoder.spec);
    const int channels = std::min(decoder.spec.nchannels, 4);
    const PixelType type = pixel_type_of(decoder.spec.format);
    LoadedImage loaded{.image = make_image(decoder.spec.width, decoder.spec.height, channels, type)};
    if (!decoder.input->read_image(0, 0, 0, channels, type_desc_of(type), loaded.image.bytes.data()))
        fail(file, "is damaged (" + one_line(decoder.input->geterror()) + "); copy or export it again");
    return loaded;
}

void save_image(const fs::path& file, const Image& image, const ImageMetadata& metadata) {
    configure_library();
    const ImageFormat format = image_format_of_extension(path_text(file.extension()));
    if (format != ImageFormat::Png && format != ImageFormat::OpenExr)
        fail(file, "pictures are saved as .png or .exr; choose one of these extensions");
    const bool exr = format == ImageFormat::OpenExr;
    if (exr != (image.type == PixelType::F32))
        fail(file, exr ? "an .exr holds floating-point values; save this picture as .png"
                       : "a .png cannot hold floating-point values; save this picture as .exr");
    OIIO::ImageSpec spec(image.width, image.height, image.channels, type_desc_of(image.type));
    if (exr) spec["compression"] = "zip";
    spec["oiio:UnassociatedAlpha"] = 1;
    for (const auto& [key, value] : metadata) spec.attribute(key, value);
    std::vector<unsigned char> encoded;
    OIIO::Filesystem::IOVecOutput memory(encoded);
    const std::string name = exr ? "picture.exr" : "picture.png";
    const auto output = OIIO::ImageOutput::create(name, &memory);
    if (!output || !output->open(name, spec) || !output->write_image(spec.format, image.bytes.data()) ||
        !output->close())
        fail(file, "could not be encoded (" + one_line(output ? output->geterror() : OIIO::geterror()) + ")");
    write_file(file, std::as_bytes(std::span(encoded)));
}

}  // namespace patina
