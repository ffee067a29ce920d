// The one door for parts: panels, importers, exporters, environment sources and built-in meshes. A part is a
// plain value; the built-in ones are listed in builtin_parts(), in registry.cpp, and a loaded shared object
// would call the same add.
#pragma once

#include "renderer/core/environment.h"
#include "renderer/core/image_io.h"
#include "renderer/core/mesh.h"
#include "renderer/ibl/bake.h"
#include "ui/panel_context.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace patina {

/// A source of light. list() may be called often and must not open files it does not have to; load() runs on
/// a worker and throws std::runtime_error with one sentence.
struct EnvironmentItem {
    std::string id;  ///< what --env takes and documents store: "studio", or a path
    std::string title;
    std::string description;
};
/// Light that needs no baking, and the panorama that is seen behind things.
struct BakedLight {
    Environment environment;
    BakedEnvironment baked;
};
struct EnvironmentSource {
    std::string name;  ///< "built-in", "blender", "file"
    std::string description;
    std::function<std::vector<EnvironmentItem>()> list;
    std::function<bool(const std::string& id)> accepts;
    std::function<Environment(const std::string& id)> load;
    std::function<BakedLight(const std::string& id)> load_baked =
        {};  ///< instead of load, where the source bakes
    /// Tells the contents of an id from others it may have at another time, without decoding them; nullopt,
    /// or no function, where that cannot be known.
    std::function<std::optional<std::uint64_t>(const std::string& id)> fingerprint = {};
};

/// extensions: lower case, without the dot. load throws std::runtime_error with one sentence that names the
/// file.
struct ImageImporter {
    std::string name;
    std::string description;
    std::vector<std::string> extensions;
    std::function<LoadedImage(const std::filesystem::path&)> load;
    /// The same row by row, and the notes; may be empty.
    std::function<std::vector<std::string>(const std::filesystem::path&, const ImageRows&)> load_rows = {};
};
struct MeshImporter {
    std::string name;
    std::string description;
    std::vector<std::string> extensions;
    /// stop: nobody waits for it any more; it may then throw.
    std::function<Mesh(const std::filesystem::path&, const std::stop_token& stop)> load;
};
/// Writes pictures; atomic; chosen by the file's extension.
struct ImageExporter {
    std::string name;
    std::string description;
    std::vector<std::string> extensions;
    std::function<void(const std::filesystem::path&, const Image&, const ImageMetadata&)> save;
};
struct MeshPart {
    std::string id;
    std::string title;
    std::string description;
    std::function<Mesh()> make;
};
struct Registry {
    std::vector<EnvironmentSource> environments;
    std::vector<ImageImporter> image_importers;
    std::vector<MeshImporter> mesh_importers;
    std::vector<ImageExporter> image_exporters;
    std::vector<MeshPart> meshes;
    std::vector<ui::Panel> panels;
};

/// Everything that ships with the program.
Registry builtin_parts();

/// The shipped presets: every .json in share_folder()/presets, by file name.
std::vector<std::filesystem::path> shipped_presets();
/// A preset as a person names it: a file, or a shipped one's name ("gold"). Throws std::runtime_error.
std::filesystem::path find_preset(const std::string& name);

/// By id ("studio") or file path; throws std::runtime_error that names what was asked for and what there is.
Environment load_environment(const Registry& registry, const std::string& id);
/// What it is called in pictures and lists, without loading it.
std::string environment_title(const Registry& registry, const std::string& id);
/// Likewise, with its light where the source has that baked.
struct LoadedLight {
    Environment environment;
    std::optional<BakedEnvironment> baked;
};
LoadedLight load_light(const Registry& registry, const std::string& id);
/// As EnvironmentSource::fingerprint.
std::optional<std::uint64_t> environment_fingerprint(const Registry& registry, const std::string& id);
/// By id ("sphere") or file path; likewise.
Mesh load_mesh_part(const Registry& registry, const std::string& id, const std::stop_token& stop = {});
/// By the file's extension; likewise.
LoadedImage import_image(const Registry& registry, const std::filesystem::path& file);
/// The same row by row, as load_image_rows.
std::vector<std::string> import_image_rows(const Registry& registry, const std::filesystem::path& file,
                                           const ImageRows& rows);

/// The exporter of the file's extension; throws std::runtime_error that names what there is, before anything
/// is computed.
const ImageExporter& image_exporter(const Registry& registry, const std::filesystem::path& file);

}  // namespace patina
