// patina list: what there is to name on the command line, and every part that came through the registry.
#include "app/commands.h"
#include "app/console.h"
#include "materials/material_io.h"
#include "materials/text_io.h"

#include <cstdio>

namespace patina {

namespace {

void row(const std::string& name, const std::string& kind, const std::string& text) {
    std::printf("%-18s %-20s %s\n", harmless(name).c_str(), harmless(kind).c_str(), harmless(text).c_str());
}

std::string extensions_of(const std::vector<std::string>& extensions) {
    std::string text;
    for (const std::string& extension : extensions) text += (text.empty() ? " (." : " .") + extension;
    return text.empty() ? text : text + ")";
}

void list_presets() {
    for (const std::filesystem::path& file : shipped_presets()) {
        const Material material = load_material(file).material;
        row(path_to_utf8(file.stem()), material.name, material.source);
    }
}

void list_plugins(const Registry& registry) {
    for (const auto& part : registry.environments) row(part.name, "environment source", part.description);
    for (const auto& part : registry.image_importers)
        row(part.name, "image importer", part.description + extensions_of(part.extensions));
    for (const auto& part : registry.mesh_importers)
        row(part.name, "mesh importer", part.description + extensions_of(part.extensions));
    for (const auto& part : registry.image_exporters)
        row(part.name, "image exporter", part.description + extensions_of(part.extensions));
    for (const auto& part : registry.meshes) row(part.id, "mesh", part.description);
    for (const auto& part : registry.panels) row(part.id, "panel", part.description);
}

}  // namespace

int run_list(const std::string& what, const Registry& registry) {
    if (what == "environments") {
        for (const EnvironmentSource& source : registry.environments)
            for (const EnvironmentItem& item : source.list()) row(item.id, item.title, item.description);
    } else if (what == "meshes") {
        for (const MeshPart& part : registry.meshes) row(part.id, part.title, part.description);
    } else if (what == "presets") {
        list_presets();
    } else {
        list_plugins(registry);
    }
    return 0;
}

}  // namespace patina
