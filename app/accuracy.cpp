#include "app/accuracy.h"

#include "renderer/core/flip.h"
#include "renderer/core/metrics.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace patina {

namespace {

constexpr int kFirstMeasurement = 256;  ///< samples that say something

/// Everything a picture depends on.
struct Signature {
    Scene scene;
    glm::ivec2 size{0};
    bool operator==(const Signature&) const = default;
};

Scene with_shading(Scene scene, Shading shading) {
    scene.view.shading = shading;
    scene.view.debug = DebugView::Final;
    return scene;
}

struct Pictures {
    Image shaded, reference, mask;
    Shading mode = Shading::SplitSum;
    int samples = 0;
};
MeasuredError measure(const Pictures& pictures) {
    MeasuredError measured{.mode = pictures.mode, .samples = pictures.samples};
    measured.error = picture_error(pictures.shaded, pictures.reference, pictures.mask);
    measured.relative = relative_error(pictures.shaded, pictures.reference);
    measured.error_map = viridis_picture(measured.relative, kErrorWhite);
    measured.flip = hdr_flip(pictures.reference, pictures.shaded);
    measured.mean_flip = mean_value(measured.flip, pictures.mask);
    measured.flip_map = viridis_picture(measured.flip, kFlipWhite);
    measured.signed_map = difference_picture(pictures.shaded, pictures.reference, DifferenceKind::Signed);
    return measured;
}

}  // namespace

namespace {
/// Those that are seen.
std::vector<ui::Layer> layers_of(const ui::AccuracySettings& settings) {
    std::vector<ui::Layer> layers{settings.left};
    if (settings.split) layers.push_back(settings.right);
    return layers;
}

bool is_map(const ui::Layer& layer) { return layer.kind != ui::Layer::View && layer.kind != ui::Layer::Mode; }
}  // namespace

struct AccuracyMeter::State {
    Renderer& renderer;
    Jobs& jobs;
    std::unique_ptr<Reference> reference;
    TargetHandle reference_target;
    Signature seen;  ///< what the reference gathers
    bool gathering = false;
    bool wanted = false;
    std::shared_ptr<const LightSampler> sampler;  ///< of sampler_of, once its job is done
    EnvironmentHandle sampler_of;
    Jobs::Id sampler_job = 0;
    struct Other {
        TargetHandle target;
        Signature seen;
    };
    std::map<Shading, Other> others;  ///< pictures of other modes
    Jobs::Id job = 0;
    int measured_samples = 0;
    Shading measured_mode = Shading::SplitSum;
    Shading judged = Shading::SplitSum;
    MapHandle error_map, flip_map, signed_map;
    std::shared_ptr<const MeasuredError> last;
    ui::AccuracyStatus status;

    void draw_other(const Scene& scene, glm::ivec2 size, Shading shading);
    bool has_sampler(const std::shared_ptr<State>& self, const EnvironmentHandle& environment);
    void gather(const std::shared_ptr<State>& self, const Scene& scene, glm::ivec2 size);
    void forget_measurement();
    void start_measurement(const std::shared_ptr<State>& self, const Scene& scene);
    bool measurement_due() const;
};

void AccuracyMeter::State::draw_other(const Scene& scene, glm::ivec2 size, Shading shading) {
    Other& other = others[shading];
    const Scene shown = with_shading(scene, shading);
    const Signature now{shown, size};
    if (other.target && other.seen == now) return;
    if (!other.target || Renderer::size_px(*other.target) != size) other.target = renderer.make_target(size);
    renderer.draw(shown, *other.target);
    other.seen = now;
}

void AccuracyMeter::State::forget_measurement() {
    if (job != 0) jobs.stop(job);
    job = 0;
    measured_samples = 0;
    error_map = flip_map = signed_map = nullptr;
    last = nullptr;
    status = {};
}

/// Made on a worker: a pass over all texels of a panorama would hold a frame up. Where it fails, restart
/// makes it.
bool AccuracyMeter::State::has_sampler(const std::shared_ptr<State>& self,
                                       const EnvironmentHandle& environment) {
    if (sampler_of != environment) {
        if (sampler_job != 0) jobs.stop(sampler_job);
        sampler = nullptr;
        sampler_of = environment;
        const auto texels = std::make_shared<PanoramaTexels>(Reference::panorama_of(environment));
        sampler_job = jobs.start(
            "Weighing the light for the reference",
            [self, texels](JobContext&) -> Jobs::Done {
                const auto made = std::make_shared<const LightSampler>(std::move(*texels));
                return [self, made] {
                    self->sampler_job = 0;
                    self->sampler = made;
                };
            },
            [self](const std::string&) { self->sampler_job = 0; });
    }
    return sampler_job == 0;
}

void AccuracyMeter::State::gather(const std::shared_ptr<State>& self, const Scene& scene, glm::ivec2 size) {
    const Scene shown = with_shading(scene, Shading::Reference);
    const Signature now{shown, size};
    if (!reference || reference->size_px() != size) {
        reference_target = renderer.make_target(size, 1, TargetPrecision::Full);
        reference = std::make_unique<Reference>(renderer, Renderer::size_px(*reference_target));
        gathering = false;
    }
    if (!gathering || !(seen == now)) {
        forget_measurement();
        gathering = has_sampler(self, shown.environment);
        if (!gathering) return;
        reference->restart(shown, sampler);
        seen = now;
    }
    if (reference->progress().done) return;
    reference->draw_for(AccuracyMeter::kStepSeconds);
    reference->write(*reference_target);
    const ReferenceProgress& progress = reference->progress();
    status.samples = progress.samples;
    status.converged = progress.converged;
    status.done = progress.done;
    if (progress.confidence) status.half_width = progress.confidence->p95;
}

/// At first early, then each time the samples have doubled, and at the end.
bool AccuracyMeter::State::measurement_due() const {
    if (!gathering || job != 0) return false;
    if (measured_mode != judged && measured_samples > 0) return true;
    const ReferenceProgress& progress = reference->progress();
    if (progress.done) return measured_samples < progress.samples;
    return progress.samples >= std::max(kFirstMeasurement, 4 * measured_samples);
}

void AccuracyMeter::State::start_measurement(const std::shared_ptr<State>& self, const Scene& scene) {
    const Scene shown = with_shading(scene, judged);
    const TargetHandle target =
        renderer.make_target(Renderer::size_px(*reference_target), 4, TargetPrecision::Full);
    status.frame_ms = renderer.timed_draw(shown, *target);
    const auto pictures = std::make_shared<Pictures>(
        Pictures{renderer.read_radiance(*target), renderer.read_radiance(*reference_target),
                 reference->inner_pixels(), judged, reference->progress().samples});
    measured_samples = reference->progress().samples;
    status.measured = status.measured && measured_mode == judged;
    measured_mode = judged;
    job = jobs.start(
        "Measuring the shading's error",
        [self, pictures](JobContext&) -> Jobs::Done {
            const auto measured = std::make_shared<const MeasuredError>(measure(*pictures));
            return [self, measured] {
                self->job = 0;
                self->status.measured = true;
                self->status.rms = measured->error.rms;
                self->status.p95 = measured->error.p95;
                self->status.max = measured->error.max;
                self->status.flip = measured->mean_flip;
                self->last = measured;
                self->error_map = self->renderer.upload_thumbnail(measured->error_map);
                self->flip_map = self->renderer.upload_thumbnail(measured->flip_map);
                self->signed_map = self->renderer.upload_thumbnail(measured->signed_map);
            };
        },
        [self](const std::string&) { self->job = 0; });
}

AccuracyMeter::AccuracyMeter(Renderer& renderer, Jobs& jobs)
    : state_(new State{.renderer = renderer,
                       .jobs = jobs,
                       .reference = {},
                       .reference_target = {},
                       .seen = {},
                       .sampler = {},
                       .sampler_of = {},
                       .others = {},
                       .error_map = {},
                       .flip_map = {},
                       .signed_map = {},
                       .last = {},
                       .status = {}}) {}

AccuracyMeter::~AccuracyMeter() = default;

std::vector<Shading> modes_shown(const ui::AccuracySettings& settings) {
    std::vector<Shading> modes;
    for (const ui::Layer& layer : layers_of(settings))
        if (layer.kind == ui::Layer::Mode && layer.mode != Shading::Reference) modes.push_back(layer.mode);
    return modes;
}

void AccuracyMeter::update(const Scene& scene, glm::ivec2 size_px, const ui::AccuracySettings& settings,
                           bool held) {
    State& state = *state_;
    const bool final_picture = scene.view.debug == DebugView::Final;
    state.judged = scene.view.shading == Shading::Reference ? View{}.shading : scene.view.shading;
    bool measure = settings.meter;
    bool reference = settings.meter || scene.view.shading == Shading::Reference;
    for (const ui::Layer& layer : layers_of(settings)) {
        measure = measure || is_map(layer);
        reference =
            reference || measure || (layer.kind == ui::Layer::Mode && layer.mode == Shading::Reference);
    }
    for (const Shading mode : modes_shown(settings)) state.draw_other(scene, size_px, mode);
    const bool moves = held && !(state.seen == Signature{with_shading(scene, Shading::Reference), size_px});
    state.wanted = reference && final_picture && !moves;
    if (!state.wanted) return;
    state.gather(state_, scene, size_px);
    if (measure && state.measurement_due()) state.start_measurement(state_, scene);
}

bool AccuracyMeter::busy() const {
    const State& state = *state_;
    return state.wanted && (!state.gathering || !state.reference->progress().done);
}

ui::Viewport::Picture AccuracyMeter::picture(ui::Layer layer) const {
    const State& state = *state_;
    const auto map = [](const MapHandle& handle) -> ui::Viewport::Picture {
        return handle ? ui::Viewport::Picture{Renderer::texture_of(*handle), false} : ui::Viewport::Picture{};
    };
    if (layer.kind == ui::Layer::Error) return map(state.error_map);
    if (layer.kind == ui::Layer::Flip) return map(state.flip_map);
    if (layer.kind == ui::Layer::Signed) return map(state.signed_map);
    const RenderTarget* drawn = target(layer);
    return drawn ? ui::Viewport::Picture{Renderer::display_texture(*drawn), true} : ui::Viewport::Picture{};
}

const RenderTarget* AccuracyMeter::target(ui::Layer layer) const {
    const State& state = *state_;
    if (layer.kind != ui::Layer::Mode) return nullptr;
    if (layer.mode == Shading::Reference) {
        const bool there = state.wanted && state.gathering && state.reference->progress().samples > 0;
        return there ? state.reference_target.get() : nullptr;
    }
    const auto found = state.others.find(layer.mode);
    return found != state.others.end() ? found->second.target.get() : nullptr;
}

std::shared_ptr<const AccuracyPictures> AccuracyMeter::pictures() const {
    const State& state = *state_;
    if (!state.wanted || !state.gathering || state.reference->progress().samples == 0) return nullptr;
    return std::make_shared<AccuracyPictures>(
        AccuracyPictures{state.renderer.read_radiance(*state.reference_target),
                         state.renderer.read_display(*state.reference_target),
                         state.reference->progress().samples, state.last});
}

const ui::AccuracyStatus& AccuracyMeter::status() const { return state_->status; }

}  // namespace patina
