// The workers' side of reconcile: from a file or an id to what can be uploaded. Pure but for the files they
// read; know no GPU and no document.
#pragma once

#include "app/jobs.h"
#include "app/registry.h"
#include "renderer/map_range.h"
#include "renderer/renderer.h"

#include <cstddef>
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
/// The same from rows.
class SmallPicture {
public:
    SmallPicture(int max_side, bool linear) : max_side_(max_side), linear_(linear) {}
    void begin(const Image& shape);  ///< once, first; its bytes do not matter
    void row(const std::byte* row);  ///< each of the picture's, from the top
    std::uint64_t bytes_read() const { return std::uint64_t(row_at_) * row_.bytes.size(); }
    Image take() { return std::move(small_); }  ///< once, after the last row

private:
    int source_row(int sample) const;
    void add_row();

    int max_side_;
    bool linear_;
    int samples_ = 1;  ///< a side, of each pixel
    Image row_;        ///< of the picture
    int height_ = 0, row_at_ = 0;
    Image small_;
    std::vector<float> sums_;  ///< of the row of small_ that samples are added to
    int sample_ = 0;           ///< next row of samples
};
/// A panorama, tone-mapped, width × width/2; its lights that are kept apart are white here.
Image small_panorama(const Environment& environment, int width);
Image small_panorama(const PanoramaLevels& panorama, int width);

/// The last part of a path or id, for labels.
std::string short_name(const std::string& id);

}  // namespace patina
