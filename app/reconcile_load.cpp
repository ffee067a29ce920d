#include "app/reconcile_load.h"

#include "app/stats.h"
#include "materials/material_io.h"
#include "materials/params.h"
#include "materials/text_io.h"
#include "renderer/map_detail.h"

#include <algorithm>
#include <cmath>
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
    // Numbers may be averaged by the decoder; colours are averaged as light, normals with their spread.
    LoadedImage loaded =
        import_image(registry, file, request.kind == MapKind::Data ? request.finest_side : 0);
    ReadyMap ready{.width = std::max(loaded.whole_width, loaded.image.width),
                   .height = std::max(loaded.whole_height, loaded.image.height),
                   .channels = loaded.image.channels,
                   .bits = bits_of(loaded.image.type),
                   .notes = std::move(loaded.notes)};
    const auto bytes = fs::file_size(file, ignored);
    ready.file_bytes = ignored ? 0 : bytes;
    const bool linear_color = request.kind == MapKind::Color && request.color_space == ColorSpace::Linear;
    ready.thumbnail = small_picture(loaded.image, kThumbnailPx, linear_color);
    auto levels = std::make_shared<MapLevels>(
        make_map_levels(loaded.image, request.kind, request.color_space, request.finest_side));
    ready.is_whole = levels->levels[0].width == ready.width && levels->levels[0].height == ready.height;
    ready.ranges = channel_ranges(*levels);
    if (request.finest_side > 0) keep_one_texel_of_constant(*levels, ready.ranges);
    count_map(ready.work, loaded.image, *levels);
    ready.levels = std::move(levels);
    return ready;
}

Image small_picture(const Image& image, int max_side, bool linear) {
    const float shrink = std::max(1.0f, float(std::max(image.width, image.height)) / float(max_side));
    const int width = std::max(1, int(std::lround(float(image.width) / shrink)));
    const int height = std::max(1, int(std::lround(float(image.height) / shrink)));
    Image small = make_image(width, height, 3, PixelType::U8);
    const int samples = shrink > 1.0f ? kSamplesPerSide : 1;
    const auto sample = [&](int x, int y, int channel) {
        float sum = 0.0f;
        for (int j = 0; j < samples; ++j)
            for (int i = 0; i < samples; ++i) {
                const float u = (float(x) + (float(i) + 0.5f) / float(samples)) / float(width);
                const float v = (float(y) + (float(j) + 0.5f) / float(samples)) / float(height);
                sum += texel(image, std::min(int(u * float(image.width)), image.width - 1),
                             std::min(int(v * float(image.height)), image.height - 1), channel);
            }
        return sum / float(samples * samples);
    };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c) {
                const float value = sample(x, y, image.channels < 3 ? 0 : c);
                set_texel(small, x, y, c, linear ? linear_to_srgb(value) : value);
            }
    return small;
}

Image small_panorama(const Environment& environment, int width) {
    const int height = std::max(1, width / 2);
    Image small = make_image(width, height, 3, PixelType::U8);
    const auto range = [](int i, int n, int source) {
        const int begin = int(std::int64_t(i) * source / n);
        return std::pair{begin, std::max(begin + 1, int(std::int64_t(i + 1) * source / n))};
    };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const auto [x0, x1] = range(x, width, environment.width);
            const auto [y0, y1] = range(y, height, environment.height);
            glm::vec3 sum(0.0f);
            for (int j = y0; j < y1; ++j)
                for (int i = x0; i < x1; ++i)
                    sum += environment.radiance[std::size_t(j) * environment.width + i];
            sum /= float((x1 - x0) * (y1 - y0));
            for (int c = 0; c < 3; ++c) set_texel(small, x, y, c, display_value(sum[c]));
        }
    return small;
}

std::string short_name(const std::string& id) {
    const std::size_t slash = id.find_last_of("/\\");
    return slash == std::string::npos ? id : id.substr(slash + 1);
}

}  // namespace patina
