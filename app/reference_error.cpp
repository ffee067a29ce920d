#include "app/reference_error.h"

#include "renderer/core/flip.h"
#include "renderer/reference.h"

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

float ReferenceSearch::done() const { return reference_->share_done(); }

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
