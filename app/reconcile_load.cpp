#include "app/reconcile_load.h"

#include "app/stats.h"
#include "materials/material_io.h"
#include "materials/params.h"
#include "materials/text_io.h"
#include "renderer/gl/half.h"
#include "renderer/map_detail.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace patina {

namespace fs = std::filesystem;

namespace {

constexpr int kSamplesPerSide =
    4;  ///< of a small picture's pixel: enough against glitter, cheap for 8k sources

int bits_of(PixelType type) { return int(bytes_per_channel(type)) * 8; }

/// Nearly leaves mid-grey where it is and rolls lamps off to white.
float display_value(float linear) { return linear_to_srgb(linear / (1.0f + 0.25f * linear)); }

}  // namespace

MapRequest map_request(const Material& material, MapSlot slot) {
    const ConstMapRef row = map_of(material, slot);
    return {.file = *row.map,
            .kind = map_kind(slot),
            .color_space = row.color_space ? *row.color_space : ColorSpace::Linear};
}

void copy_slot(const Material& from, Material& to, MapSlot slot) {
    switch (slot) {
        case MapSlot::Albedo:
            to.albedo = from.albedo;
            break;
        case MapSlot::Roughness:
            to.roughness = from.roughness;
            break;
        case MapSlot::Metallic:
            to.metallic = from.metallic;
            break;
        case MapSlot::Ao:
            to.ao = from.ao;
            break;
        case MapSlot::Normal:
            to.normal = from.normal;
            break;
        case MapSlot::Emission:
            to.emission = from.emission;
            break;
    }
}

ReadyMap load_map(const Registry& registry, const MapRequest& request) {
    if (is_web_address(request.file))
        throw std::runtime_error(
            request.file +
            " is a web address, and nothing is fetched: save the picture and locate the file.");
    const fs::path file = utf8_to_path(request.file);
    std::error_code ignored;
    if (!fs::exists(file, ignored))
        throw std::runtime_error(request.file + ": there is no such file; put it back or locate it.");
    MapMaker maker(request.kind, request.color_space, request.finest_side);
    SmallPicture small(kThumbnailPx,
                       request.kind == MapKind::Color && request.color_space == ColorSpace::Linear);
    ReadyMap ready;
    ready.notes = import_image_rows(registry, file,
                                    {.begin =
                                         [&](const Image& shape) {
                                             maker.begin(shape);
                                             small.begin(shape);
                                         },
                                     .row =
                                         [&](const std::byte* row) {
                                             maker.row(row);
                                             small.row(row);
                                         }});
    const Image shape = maker.shape();
    ready.width = shape.width;
    ready.height = shape.height;
    ready.channels = shape.channels;
    ready.bits = bits_of(shape.type);
    const auto bytes = fs::file_size(file, ignored);
    ready.file_bytes = ignored ? 0 : bytes;
    ready.thumbnail = small.take();
    count_reading(ready.work, maker);
    ready.is_whole = maker.is_whole();
    auto levels = std::make_shared<MapLevels>(maker.take());
    levels->ranges = channel_ranges(*levels);
    const bool single = request.finest_side > 0 && keep_one_texel_of_constant(*levels);
    count_upload(ready.work, *levels, single);
    ready.levels = std::move(levels);
    return ready;
}

void SmallPicture::begin(const Image& shape) {
    const float shrink = std::max(1.0f, float(std::max(shape.width, shape.height)) / float(max_side_));
    small_ = make_image(std::max(1, int(std::lround(float(shape.width) / shrink))),
                        std::max(1, int(std::lround(float(shape.height) / shrink))), 3, PixelType::U8);
    samples_ = shrink > 1.0f ? kSamplesPerSide : 1;
    row_ = make_image(shape.width, 1, shape.channels, shape.type);
    height_ = shape.height;
    sums_.assign(std::size_t(small_.width) * 3, 0.0f);
}

/// The picture's row that a row of samples is taken from.
int SmallPicture::source_row(int sample) const {
    const float v = (float(sample) + 0.5f) / float(samples_ * small_.height);
    return std::min(int(v * float(height_)), height_ - 1);
}

void SmallPicture::row(const std::byte* row) {
    const int last = samples_ * small_.height;
    if (sample_ < last && source_row(sample_) == row_at_) {
        std::memcpy(row_.bytes.data(), row, row_.bytes.size());
        while (sample_ < last && source_row(sample_) == row_at_) add_row();
    }
    ++row_at_;
}

void SmallPicture::add_row() {
    for (int x = 0; x < small_.width; ++x)
        for (int i = 0; i < samples_; ++i) {
            const float u = (float(x * samples_ + i) + 0.5f) / float(samples_ * small_.width);
            const int from = std::min(int(u * float(row_.width)), row_.width - 1);
            for (int c = 0; c < 3; ++c) sums_[3 * x + c] += texel(row_, from, 0, row_.channels < 3 ? 0 : c);
        }
    if (++sample_ % samples_ != 0) return;
    for (int x = 0; x < small_.width; ++x)
        for (int c = 0; c < 3; ++c) {
            const float value = sums_[3 * x + c] / float(samples_ * samples_);
            set_texel(small_, x, sample_ / samples_ - 1, c, linear_ ? linear_to_srgb(value) : value);
        }
    std::fill(sums_.begin(), sums_.end(), 0.0f);
}

Image small_picture(const Image& image, int max_side, bool linear) {
    SmallPicture small(max_side, linear);
    give_rows(image, {.begin = [&](const Image& shape) { small.begin(shape); },
                      .row = [&](const std::byte* row) { small.row(row); }});
    return small.take();
}

namespace {

/// radiance: of the texel at x, y.
template <class Radiance>
Image small_panorama_of(glm::ivec2 size, int width, const Radiance& radiance) {
    const int height = std::max(1, width / 2);
    Image small = make_image(width, height, 3, PixelType::U8);
    const auto range = [](int i, int n, int source) {
        const int begin = int(std::int64_t(i) * source / n);
        return std::pair{begin, std::max(begin + 1, int(std::int64_t(i + 1) * source / n))};
    };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const auto [x0, x1] = range(x, width, size.x);
            const auto [y0, y1] = range(y, height, size.y);
            glm::vec3 sum(0.0f);
            for (int j = y0; j < y1; ++j)
                for (int i = x0; i < x1; ++i) sum += radiance(i, j);
            sum /= float((x1 - x0) * (y1 - y0));
            for (int c = 0; c < 3; ++c) set_texel(small, x, y, c, display_value(sum[c]));
        }
    return small;
}

}  // namespace

Image small_panorama(const Environment& environment, int width) {
    return small_panorama_of({environment.width, environment.height}, width, [&](int x, int y) {
        return environment.radiance[std::size_t(y) * environment.width + x];
    });
}

Image small_panorama(const PanoramaLevels& panorama, int width) {
    const float scale = std::ldexp(1.0f, panorama.exponent);
    const PanoramaLevels::Level& level = panorama.levels.front();
    return small_panorama_of({level.width, level.height}, width, [&](int x, int y) {
        const std::uint16_t* rgba = &level.rgba[4 * (std::size_t(y) * level.width + x)];
        const glm::vec4 value(gl::from_half(rgba[0]), gl::from_half(rgba[1]), gl::from_half(rgba[2]),
                              gl::from_half(rgba[3]));
        return scale * (glm::vec3(value) + value.w);
    });
}

std::string short_name(const std::string& id) {
    const std::size_t slash = id.find_last_of("/\\");
    return slash == std::string::npos ? id : id.substr(slash + 1);
}

}  // namespace patina
