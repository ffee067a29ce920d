#include "app/reference_error.h"

#include "renderer/core/flip.h"
#include "renderer/reference.h"

namespace patina {

namespace {
constexpr glm::ivec2 kSize{128};
}

ReferenceSearch::ReferenceSearch(Renderer& renderer, int samples)
    : renderer_(renderer),
      samples_((samples + 7) / 8 * 8),
      reference_(std::make_unique<Reference>(renderer, kSize,
                                             ReferenceOptions{.max_samples = samples_, .tolerance = 0.0})) {}

ReferenceSearch::~ReferenceSearch() = default;

void ReferenceSearch::begin(const Scene& scene) {
    scene_ = scene;
    Scene truth = scene;
    truth.view.shading = Shading::Reference;
    reference_->restart(truth);
}

bool ReferenceSearch::step() {
    reference_->draw();
    return !reference_->progress().done;
}

float ReferenceSearch::done() const { return float(reference_->progress().samples) / float(samples_); }

ReferenceError ReferenceSearch::result() {
    const TargetHandle gathered = renderer_.make_target(kSize, 1, TargetPrecision::Full);
    reference_->write(*gathered);
    const TargetHandle shaded = renderer_.make_target(kSize, 4, TargetPrecision::Full);
    renderer_.draw(scene_, *shaded);
    const Image expected = renderer_.read_radiance(*gathered), found = renderer_.read_radiance(*shaded),
                mask = reference_->inner_pixels();
    const auto& known = reference_->progress().confidence;
    return {picture_error(found, expected, mask), mean_value(hdr_flip(expected, found), mask),
            known ? known->p95 : 0.0};
}

}  // namespace patina
