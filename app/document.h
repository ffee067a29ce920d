// What the artist works on, as plain values compared with ==: what is saved (the material), what is undone
// (all of it) and where it came from. Knows no window and no GPU.
#pragma once

#include "materials/material.h"
#include "renderer/core/camera.h"
#include "renderer/core/comparison.h"
#include "renderer/core/view.h"

#include <filesystem>
#include <optional>
#include <string>

namespace patina {

/// One state of the work; undo is a list of these. Maps are named by full path here, whatever the preset
/// writes, so that a state means the same after the preset was saved elsewhere. The camera is not part of it:
/// looking is not editing.
struct Document {
    Material material;
    std::string mesh = "sphere";         ///< id of a built-in one, or a path
    std::string environment = "studio";  ///< likewise
    View view;
    std::optional<Comparison> sheet;  ///< shown instead of the one view; has a file of its own
    int sheet_opened = 0;             ///< which of the sheets that were begun or opened it is
    bool operator==(const Document&) const = default;
};

/// The file behind the work. A new document has no path and the default material.
struct DocumentFile {
    std::filesystem::path path;  ///< empty: never saved
    Material as_written;         ///< what the file holds, maps as it names them
    Material saved;              ///< the same, maps by full path
};

bool is_dirty(const Document& document, const DocumentFile& file);
/// The material's name; without one the file's, without folder and extension; else "Untitled".
std::string document_title(const Document& document, const DocumentFile& file);

/// Maps by full path ('/'), relative ones as seen from the preset; a web address stays what it is.
Material with_full_map_paths(const Material& as_written, const std::filesystem::path& preset);
/// Maps as that preset names them: the text of before where it means the same file, else relative where there
/// is a way.
Material with_preset_map_paths(const Material& material, const std::filesystem::path& preset,
                               const Material& before);

/// A few words for the undo menu: "Roughness", "Environment", "Albedo map"; "3 values" when many differ;
/// empty if none does.
std::string describe_change(const Document& before, const Document& after);

}  // namespace patina
