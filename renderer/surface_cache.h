// Which surfaces are kept to be shaded again: what tells one from another, and how long they stay. Knows no
// GPU.
#pragma once

#include "materials/material.h"
#include "renderer/core/camera.h"
#include "renderer/core/crop.h"
#include "renderer/features.h"

#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <utility>
#include <vector>

namespace patina {

/// Everything that rasterising a surface depends on. Values that shading multiplies maps by are not among it.
struct SurfaceKey {
    std::weak_ptr<const void> mesh;
    std::array<std::weak_ptr<const void>, kMapSlots> maps;  ///< only those that are read
    std::array<Channel, 3> channels{};  ///< of roughness, metallic and occlusion, where mapped
    Features features = 0;              ///< which maps, and whether sharp lobes need more
    Camera camera;
    Crop crop;
    glm::ivec2 size_px{0};
    int samples = 1;
    UvTransform uv;                ///< without maps the usual one
    float normal_strength = 0.0f;  ///< without a normal map 0
    NormalConvention normal_convention = NormalConvention::OpenGl;
};

inline bool is_same(const std::weak_ptr<const void>& a, const std::weak_ptr<const void>& b) {
    return !a.owner_before(b) && !b.owner_before(a);
}
inline bool operator==(const SurfaceKey& a, const SurfaceKey& b) {
    for (std::size_t i = 0; i < a.maps.size(); ++i)
        if (!is_same(a.maps[i], b.maps[i])) return false;
    return is_same(a.mesh, b.mesh) && a.channels == b.channels && a.features == b.features &&
           a.camera == b.camera && a.crop == b.crop && a.size_px == b.size_px && a.samples == b.samples &&
           a.uv == b.uv && a.normal_strength == b.normal_strength &&
           a.normal_convention == b.normal_convention;
}

/// Surfaces by key, bounded by their bytes; the least recently used go first, and those that many other
/// pictures passed by.
template <class Surface>
class SurfaceCache {
public:
    std::shared_ptr<const Surface> find(const SurfaceKey& key) { return find(key, key); }
    /// The first of the two that is there, for one picture.
    std::shared_ptr<const Surface> find(const SurfaceKey& key, const SurfaceKey& other) {
        ++now_;
        std::erase_if(kept_, [&](const Kept& each) { return now_ - each.used > kIdlePictures; });
        auto found = std::ranges::find(kept_, key, &Kept::key);
        if (found == kept_.end()) found = std::ranges::find(kept_, other, &Kept::key);
        if (found == kept_.end()) return {};
        found->used = now_;
        return found->surface;
    }
    /// Of surfaces that differ in the camera alone the one that was used longest ago, if nothing shows it any
    /// more and newer ones are kept; it is kept no longer. A camera that moves does not come back.
    std::shared_ptr<Surface> take_old(const SurfaceKey& key) {
        SurfaceKey moved = key;
        std::vector<std::size_t> others;
        for (std::size_t i = 0; i < kept_.size(); ++i) {
            moved.camera = kept_[i].key.camera;
            if (kept_[i].key == moved) others.push_back(i);
        }
        if (others.size() <= kRecentCameras) return {};
        const std::size_t oldest =
            *std::ranges::min_element(others, {}, [&](std::size_t i) { return kept_[i].used; });
        if (kept_[oldest].surface.use_count() > 1) return {};
        std::shared_ptr<Surface> old = std::move(kept_[oldest].surface);
        kept_.erase(kept_.begin() + std::ptrdiff_t(oldest));
        return old;
    }
    void keep(const SurfaceKey& key, std::shared_ptr<Surface> surface) {
        kept_.push_front({key, std::move(surface), now_});
        std::ranges::sort(kept_, std::greater<>{}, &Kept::used);
        std::uint64_t bytes = 0;
        std::size_t count = 0;
        while (count < kept_.size() && (count == 0 || bytes + kept_[count].surface->bytes <= kMaxBytes))
            bytes += kept_[count++].surface->bytes;
        kept_.resize(count);
    }
    /// Notes that it was drawn without being kept; whether that happened before.
    bool was_drawn(const SurfaceKey& key) {
        const auto found = std::ranges::find(drawn_, key);
        if (found != drawn_.end()) return true;
        drawn_.push_front(key);
        if (drawn_.size() > kRemembered) drawn_.pop_back();
        return false;
    }
    void clear() { kept_.clear(); }
    std::size_t size() const { return kept_.size(); }

private:
    static constexpr std::uint64_t kIdlePictures = 32;
    static constexpr std::uint64_t kMaxBytes = std::uint64_t{192} << 20;
    static constexpr std::size_t kRemembered = 16;
    static constexpr std::size_t kRecentCameras = 1;
    struct Kept {
        SurfaceKey key;
        std::shared_ptr<Surface> surface;
        std::uint64_t used = 0;
    };
    std::deque<Kept> kept_;
    std::deque<SurfaceKey> drawn_;
    std::uint64_t now_ = 0;
};

}  // namespace patina
