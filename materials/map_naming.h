// Which map is this file? File names in, an import sheet out: every decision with its reason, for the artist
// to change before it is applied. Knows only names: no file is opened.
//
// The last word that names a kind of map counts ("metal_plate_diff_1k" is a diffuse map), unless the files
// share it as the name of their set ("metal_roughness" beside "metal_color"). Of two files for one slot one
// wins, and both rows say why.
#pragma once

#include "materials/material.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace patina {

enum class Confidence {
    None,    ///< not recognised, or recognised as nothing this material uses
    Guess,   ///< a single letter, or the only picture there is
    Likely,  ///< a word that could also belong to the set's name, or a convention that is not stated
    Sure
};

/// One use of one file; a packed map has a row for each of its channels.
struct ImportRow {
    std::string file;              ///< as given
    std::optional<MapSlot> slot;   ///< where it goes; none: it is not used
    std::optional<MapSlot> fits;   ///< what its name says, even if another file took the slot
    Channel channel = Channel::R;  ///< for the scalar slots, with invert
    bool invert = false;
    ColorSpace color_space = ColorSpace::Srgb;  ///< for base colour and emission
    NormalConvention convention = NormalConvention::OpenGl;
    Confidence confidence = Confidence::None;
    std::string reason;  ///< one sentence
};

struct ImportProposal {
    std::string name;             ///< of the set, as its files share it, else of their folder; may be empty
    std::vector<ImportRow> rows;  ///< those that are used first, in the order of MapSlot
    bool clear_other_maps =
        false;  ///< a whole set replaces the maps that were there; proposed from two slots on
};

/// For file names or paths in UTF-8, with slashes or backslashes. Never fails: what is not a picture gets a
/// row that says so.
ImportProposal propose_import(std::span<const std::string> files);

/// Puts a row into a slot, or into none; a row that had the slot loses it. Precondition: row < rows.size().
void choose_slot(ImportProposal& proposal, std::size_t row, std::optional<MapSlot> slot);

/// The material with those maps: `map` is the row's file as it stands, its value becomes 1 (the map alone
/// decides), and a material without a name takes the set's. If clear_other_maps, slots that keep an old map
/// go back to their defaults, and a set with a base colour but no metallic map is taken for a non-metal.
Material apply_import(Material material, const ImportProposal& proposal);

}  // namespace patina
