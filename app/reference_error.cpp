#include "app/reference_error.h"

#include "renderer/core/flip.h"
#include "renderer/reference.h"

#include <algorithm>

namespace patina {

namespace {
constexpr glm::ivec2 kSize{128};
constexpr double kStepSeconds = 0.04;
}  // namespace

ReferenceSearch::ReferenceSearch(Renderer& renderer, int samples)
    : renderer_(renderer),
      samples_((samples + 7) / 8 * 8),
      reference_(std::make_unique<Reference>(
          renderer, kSize, ReferenceOptions{.max_samples = samples_, .tolerance = kReferenceKnown})) {}

ReferenceSearch::~ReferenceSearch() = default;

void ReferenceSearch::begin(const Scene& scene) {
    scene_ = scene;
    Scene truth = scene;
    truth.view.shading = Shading::Reference;
    reference_->restart(truth);
}

bool ReferenceSearch::step() {
    reference_->draw_for(kStepSeconds);
    return !reference_->progress().done;
}

/// The half-width shrinks with the root of the number of points.
float ReferenceSearch::done() const {
    const ReferenceProgress& progress = reference_->progress();
    const double drawn = double(progress.samples) / double(samples_);
    if (!progress.confidence || progress.confidence->p95 <= 0.0) return float(drawn);
    const double known = kReferenceKnown / progress.confidence->p95;
    return float(std::clamp(std::max(drawn, known * known), 0.0, 1.0));
}

ReferencePictures ReferenceSearch::result() {
    const TargetHandle gathered = renderer_.make_target(kSize, 1, TargetPrecision::Full);
    reference_->write(*gathered);
    const TargetHandle shaded = renderer_.make_target(kSize, 4, TargetPrecision::Full);
    renderer_.draw(scene_, *shaded);
    const auto& known = reference_->progress().confidence;
    return {renderer_.read_radiance(*shaded), renderer_.read_radiance(*gathered), reference_->inner_pixels(),
            known ? known->p95 : 0.0};
}

ReferenceError error_of(const ReferencePictures& pictures) {
    return {picture_error(pictures.found, pictures.expected, pictures.mask),
            mean_value(hdr_flip(pictures.expected, pictures.found), pictures.mask), pictures.known};
}

}  // namespace patina
