// The workers' side of reconcile: from a file or an id to what can be uploaded. Pure but for the files they
// read; know no GPU and no document.
#pragma once

#include "app/jobs.h"
#include "app/registry.h"
#include "renderer/map_range.h"
#include "renderer/renderer.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace patina {

struct MapRequest {
    std::string file;  ///< full path or what else the preset named
    MapKind kind = MapKind::Data;
    ColorSpace color_space = ColorSpace::Linear;
    int finest_side = 0;  ///< as make_map_levels takes it
};
/// How a slot's map is read, with all detail; the kind of its mipmaps follows from the slot.
MapRequest map_request(const Material& material, MapSlot slot);

/// Everything of one slot, value included.
void copy_slot(const Material& from, Material& to, MapSlot slot);

struct ReadyMap {
    std::shared_ptr<const MapLevels> levels;
    ChannelRanges ranges;
    Image thumbnail;                                    ///< 3 channels of 8 bits, at most kThumbnailPx a side
    int width = 0, height = 0, channels = 0, bits = 0;  ///< of the file
    std::uint64_t file_bytes = 0;
    bool is_whole = true;  ///< no level was left out as too fine
    std::vector<std::string> notes;
    WorkLedger work;
};
inline constexpr int kThumbnailPx = 128;

/// Throws std::runtime_error with one sentence.
ReadyMap load_map(const Registry& registry, const MapRequest& request);

/// Any picture as a small one to look at: 3 channels of 8 bits. linear: its values are light and get encoded.
Image small_picture(const Image& image, int max_side, bool linear);
/// A panorama, tone-mapped, width × width/2.
Image small_panorama(const Environment& environment, int width);

/// The last part of a path or id, for labels.
std::string short_name(const std::string& id);

}  // namespace patina
