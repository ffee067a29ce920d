#include "app/registry.h"

#include "app/bake_files.h"
#include "app/paths.h"
#include "materials/text_io.h"
#include "renderer/core/environment_io.h"
#include "renderer/core/mesh_io.h"
#include "ui/workspace.h"

#include <algorithm>
#include <optional>
#include <stdexcept>

namespace patina {

namespace fs = std::filesystem;

namespace {

EnvironmentSource builtin_environment_source() {
    const auto find = [](const std::string& id) {
        return std::ranges::find(builtin_environments(), std::string_view(id), &BuiltinEnvironment::id);
    };
    return {.name = "built-in",
            .description = "Computed environments that need no file",
            .list =
                [] {
                    std::vector<EnvironmentItem> items;
                    for (const BuiltinEnvironment& each : builtin_environments())
                        items.push_back(
                            {std::string(each.id), std::string(each.title), std::string(each.description)});
                    return items;
                },
            .accepts = [find](const std::string& id) { return find(id) != builtin_environments().end(); },
            .load = [find](const std::string& id) { return find(id)->make(kBuiltinEnvironmentWidth); },
            .fingerprint = [](const std::string&) { return std::optional<std::uint64_t>(0); }};
}

EnvironmentSource blender_environment_source() {
    const auto find = [](const std::string& id) {
        std::optional<EnvironmentFile> found;
        for (const EnvironmentFile& each : list_blender_studio_lights())
            if (each.id == id) found = each;
        return found;
    };
    return {.name = "blender",
            .description = "The studio lights of an installed Blender",
            .list =
                [] {
                    std::vector<EnvironmentItem> items;
                    for (const EnvironmentFile& each : list_blender_studio_lights())
                        items.push_back({each.id, each.title, "One of Blender's studio lights."});
                    return items;
                },
            .accepts = [find](const std::string& id) { return id.starts_with("blender-") && find(id); },
            .load =
                [find](const std::string& id) {
                    Environment environment = load_environment_file(find(id).value().file);
                    environment.id = id;
                    return environment;
                },
            .fingerprint =
                [find](const std::string& id) { return environment_file_hash(find(id).value().file); }};
}

EnvironmentSource bake_environment_source() {
    return {.name = "bake",
            .description = "Light that patina bake has written: the folder, or bake.json in it",
            .list = [] { return std::vector<EnvironmentItem>{}; },
            .accepts = [](const std::string& id) { return is_bake(utf8_to_path(id)); },
            .load = [](const std::string& id) { return load_bake(utf8_to_path(id)).environment; },
            .load_baked = [](const std::string& id) { return load_bake(utf8_to_path(id)); }};
}

EnvironmentSource file_environment_source() {
    return {.name = "file",
            .description = "Equirectangular pictures: Radiance .hdr, OpenEXR .exr, or any other picture",
            .list = [] { return std::vector<EnvironmentItem>{}; },
            .accepts = [](const std::string& id) { return id.find_first_of("./\\") != std::string::npos; },
            .load = [](const std::string& id) { return load_environment_file(utf8_to_path(id)); },
            .fingerprint = [](const std::string& id) { return environment_file_hash(utf8_to_path(id)); }};
}

std::string extension_of(const fs::path& file) {
    std::string extension = path_to_utf8(file.extension());
    std::ranges::transform(extension, extension.begin(),
                           [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
    return extension.empty() ? extension : extension.substr(1);
}

/// The part that reads files with this one's extension, or nullptr.
template <class Part>
const Part* part_for(const std::vector<Part>& parts, const fs::path& file) {
    const std::string extension = extension_of(file);
    for (const Part& part : parts)
        if (std::ranges::find(part.extensions, extension) != part.extensions.end()) return &part;
    return nullptr;
}

/// "a, b or c"
std::string either(const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i)
        text += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + names[i];
    return text;
}

}  // namespace

Registry builtin_parts() {
    Registry registry;
    registry.environments = {builtin_environment_source(), blender_environment_source(),
                             bake_environment_source(), file_environment_source()};
    registry.image_importers = {{.name = "png",
                                 .description = "Pictures through libpng",
                                 .extensions = {"png"},
                                 .load = load_image,
                                 .load_rows = load_image_rows},
                                {.name = "openexr",
                                 .description = "Scene-linear pictures through OpenEXR",
                                 .extensions = {"exr"},
                                 .load = load_image},
                                {.name = "jpeg",
                                 .description = "Pictures through libjpeg",
                                 .extensions = {"jpg", "jpeg"},
                                 .load = load_image,
                                 .load_rows = load_image_rows},
                                {.name = "radiance",
                                 .description = "Radiance pictures",
                                 .extensions = {"hdr", "pic"},
                                 .load = load_image},
                                {.name = "openimageio",
                                 .description = "Pictures through OpenImageIO, loaded when first needed",
                                 .extensions = {"tif", "tiff", "tga", "bmp"},
                                 .load = load_image}};
    registry.mesh_importers = {{.name = "openmesh",
                                .description = "Meshes through OpenMesh",
                                .extensions = {"obj", "ply", "off", "stl"},
                                .load = load_mesh}};
    registry.image_exporters = {{.name = "png",
                                 .description = "The display picture, 8 bits a channel",
                                 .extensions = {"png"},
                                 .save = save_image},
                                {.name = "openexr",
                                 .description = "Scene-linear radiance, 32-bit float",
                                 .extensions = {"exr"},
                                 .save = save_image}};
    for (const BuiltinMesh& each : builtin_meshes())
        registry.meshes.push_back(
            {std::string(each.id), std::string(each.title), std::string(each.description), each.make});
    registry.panels = ui::builtin_panels();
    return registry;
}

std::vector<fs::path> shipped_presets() {
    std::vector<fs::path> files;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(share_folder() / "presets", ignored))
        if (entry.path().extension() == ".json" && !entry.path().stem().has_extension())
            files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

fs::path find_preset(const std::string& name) {
    fs::path file = utf8_to_path(name);
    std::error_code ignored;
    if (fs::exists(file, ignored)) return file;
    if (!file.has_parent_path() && !file.has_extension()) {
        fs::path shipped = share_folder() / "presets" / utf8_to_path(name + ".json");
        if (fs::exists(shipped, ignored)) return shipped;
    }
    throw std::runtime_error(
        name + ": there is no such file and no shipped preset of that name (patina list presets shows them)");
}

namespace {

const EnvironmentSource& environment_source(const Registry& registry, const std::string& id) {
    for (const EnvironmentSource& source : registry.environments)
        if (source.accepts(id)) return source;
    std::vector<std::string> ids;
    for (const EnvironmentItem& item : registry.environments.front().list()) ids.push_back(item.id);
    throw std::runtime_error("there is no environment '" + id + "'; name a picture file or one of " +
                             either(ids));
}

}  // namespace

Environment load_environment(const Registry& registry, const std::string& id) {
    return environment_source(registry, id).load(id);
}

LoadedLight load_light(const Registry& registry, const std::string& id) {
    const EnvironmentSource& source = environment_source(registry, id);
    if (!source.load_baked) return {source.load(id), std::nullopt};
    BakedLight light = source.load_baked(id);
    return {std::move(light.environment), std::move(light.baked)};
}

std::optional<std::uint64_t> environment_fingerprint(const Registry& registry, const std::string& id) {
    const EnvironmentSource& source = environment_source(registry, id);
    return source.fingerprint ? source.fingerprint(id) : std::nullopt;
}

std::string environment_title(const Registry& registry, const std::string& id) {
    for (const EnvironmentSource& source : registry.environments)
        for (const EnvironmentItem& item : source.list())
            if (item.id == id) return item.title;
    return path_to_utf8(utf8_to_path(id).stem());
}

Mesh load_mesh_part(const Registry& registry, const std::string& id, const std::stop_token& stop) {
    for (const MeshPart& part : registry.meshes)
        if (part.id == id) return part.make();
    const fs::path file = utf8_to_path(id);
    if (const MeshImporter* importer = part_for(registry.mesh_importers, file))
        return importer->load(file, stop);
    std::vector<std::string> ids;
    for (const MeshPart& part : registry.meshes) ids.push_back(part.id);
    std::vector<std::string> extensions;
    for (const MeshImporter& importer : registry.mesh_importers)
        for (const std::string& extension : importer.extensions) extensions.push_back("." + extension);
    throw std::runtime_error("there is no mesh '" + id + "'; name one of " + either(ids) +
                             ", or a file that ends in " + either(extensions));
}

namespace {

/// An unknown extension goes to the first importer, which judges by content.
const ImageImporter& image_importer(const Registry& registry, const fs::path& file) {
    const ImageImporter* importer = part_for(registry.image_importers, file);
    return importer ? *importer : registry.image_importers.front();
}

}  // namespace

LoadedImage import_image(const Registry& registry, const fs::path& file) {
    return image_importer(registry, file).load(file);
}

std::vector<std::string> import_image_rows(const Registry& registry, const fs::path& file,
                                           const ImageRows& rows) {
    const ImageImporter& importer = image_importer(registry, file);
    if (importer.load_rows) return importer.load_rows(file, rows);
    LoadedImage loaded = importer.load(file);
    give_rows(loaded.image, rows);
    return std::move(loaded.notes);
}

const ImageExporter& image_exporter(const Registry& registry, const fs::path& file) {
    if (const ImageExporter* exporter = part_for(registry.image_exporters, file)) return *exporter;
    std::vector<std::string> extensions;
    for (const ImageExporter& each : registry.image_exporters)
        for (const std::string& extension : each.extensions) extensions.push_back("." + extension);
    throw std::runtime_error(path_to_utf8(file) + ": a picture's name ends in " + either(extensions));
}

}  // namespace patina
