#include "app/photo_hints.h"

#include "renderer/core/format.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

std::string gain(const Estimate& e) {
    return formatted(" (mean ΔE %.1f → about %.1f).", double(e.now), double(e.delta_e));
}

std::string roughness_hint(const Estimate& e) {
    return formatted("The highlights are %s than in the photo: try roughness about %.2f %s",
                     e.offset > 0.0f ? "narrower" : "wider", double(std::abs(e.offset)),
                     e.offset > 0.0f ? "higher" : "lower") +
           gain(e);
}

std::string color_hint(const Estimate& e) {
    return formatted("The surface is %s than in the photo: try the base colour about %.0f %% %s",
                     e.offset > 0.0f ? "darker" : "lighter",
                     std::abs(std::exp2(double(e.offset)) - 1.0) * 100.0,
                     e.offset > 0.0f ? "brighter" : "darker") +
           gain(e);
}

}  // namespace

HintSearch::HintSearch(Image photo_in_view, std::optional<Region> region, Scene scene)
    : photo_(std::move(photo_in_view)), region_(region), scene_(std::move(scene)) {
    for (const float offset : kRoughnessTrials) {
        Material moved = scene_.material;
        moved.roughness.value += offset;
        if (moved.roughness.value >= 0.0f && moved.roughness.value <= 1.0f)
            planned_.push_back({std::move(moved), offset, false});
    }
    for (const float stops : {-1.0f, -0.5f, -0.25f, 0.0f, 0.25f, 0.5f, 1.0f}) {
        Material moved = scene_.material;
        moved.albedo.value *= std::exp2(stops);
        if (std::max({moved.albedo.value.x, moved.albedo.value.y, moved.albedo.value.z}) <= 1.0f)
            planned_.push_back({std::move(moved), stops, true});
    }
}

bool HintSearch::step(const ShootRadiance& radiance) {
    if (drawn_ == planned_.size()) return false;
    const Planned& next = planned_[drawn_];
    Scene scene = scene_;
    scene.material = next.material;
    const Residual residual = residual_of(photo_, radiance(scene), region_);
    if (residual.pixels == 0) {  // nothing to compare, whatever the material
        drawn_ = planned_.size();
        return false;
    }
    trials_[next.color ? 1 : 0].push_back({next.offset, residual.delta_e});
    return ++drawn_ < planned_.size();
}

float HintSearch::done() const { return planned_.empty() ? 1.0f : float(drawn_) / float(planned_.size()); }

std::vector<std::string> HintSearch::sentences() const {
    const std::optional<Estimate> roughness = estimate_offset(trials_[0]),
                                  color = estimate_offset(trials_[1]);
    std::vector<std::string> sentences;
    if (roughness && roughness->clear) sentences.push_back(roughness_hint(*roughness));
    if (color && color->clear) {
        const bool better = !sentences.empty() && color->delta_e < roughness->delta_e;
        sentences.insert(better ? sentences.begin() : sentences.end(), color_hint(*color));
    }
    return sentences;
}

std::vector<std::string> hints_for(const Image& photo_in_view, const std::optional<Region>& region,
                                   const Scene& scene, const ShootRadiance& radiance) {
    HintSearch search(photo_in_view, region, scene);
    while (search.step(radiance)) {
    }
    return search.sentences();
}

}  // namespace patina
