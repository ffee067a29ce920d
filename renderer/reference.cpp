#include "renderer/reference.h"

#include "renderer/gl/reference.h"
#include "renderer/ibl/low_discrepancy.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace patina {

namespace {

constexpr int kReplicates = ReferenceTarget::kReplicates;
static_assert(kReplicates == 8, "as index_in_hand deals them");
constexpr int kMostAtOnce = 64;  ///< points of a slice, each of which sees the pixel's area at one place
constexpr int kMostOfMiddle = 256;
static_assert(LightSampler::kMostCells == blocks::kLightCells);
constexpr float kWeightOfOne = 1.0f / 4096.0f;
constexpr int kMostSteps = 16;            ///< of a slice
constexpr double kFirstTolerance = 0.02;  ///< to which all pixels are known before any is known better

enum Stream : std::uint64_t { Light, Reflection, Pixel };
std::uint64_t seed_of(std::uint64_t seed, Stream stream) { return mix_bits(mix_bits(seed) + stream); }

/// Where a slice stands: which points of which replicate.
struct Place {
    int replicate = 0;
    int first = 0;
    int count = 1;
};

int longest_of(const ReferenceOptions& options) {
    return (options.max_samples + kReplicates - 1) / kReplicates;
}

gl::SlicePoints make_points(const LightSampler& light, const Place& place, const ReferenceOptions& options) {
    gl::SlicePoints points;
    points.reflection.resize(blocks::kLightCells / 4, glm::vec4(0.0f));
    for (std::size_t k = 0; k < light.cells().size() && light.total() > 0.0; ++k)
        points.reflection[k / 4][int(k % 4)] = float(light.cells()[k].light / light.total());
    for (int i = 0; i < place.count; ++i) {
        const std::uint32_t index = index_in_hand(std::uint32_t(place.first + i), place.replicate);
        const glm::dvec3 u = scrambled_sobol(index, seed_of(options.seed, Light));
        for (int k = 0; k < int(light.cells().size()); ++k) {
            const LightSample sample = light.sample(k, {u.x, u.y});
            points.light.emplace_back(glm::vec3(sample.direction), 0.0f);
            points.light.emplace_back(sample.radiance, 0.0f);
        }
        const glm::dvec3 v = scrambled_sobol(index, seed_of(options.seed, Reflection));
        const double phi = 2.0 * std::numbers::pi * v.x;
        points.reflection.emplace_back(glm::dvec4(std::cos(phi), std::sin(phi), v.y, v.z));
    }
    return points;
}

/// Of each pixel and those up to two away, one axis after the other.
std::vector<float> largest_around(std::vector<float> values, glm::ivec2 size) {
    constexpr int reach = 2;
    std::vector<float> line(std::size_t(std::max(size.x, size.y)));
    const auto along = [&](std::size_t first, int count, std::size_t step) {
        for (int i = 0; i < count; ++i) line[std::size_t(i)] = values[first + std::size_t(i) * step];
        for (int i = 0; i < count; ++i) {
            const auto begin = line.begin() + std::max(i - reach, 0);
            const auto end = line.begin() + std::min(i + reach + 1, count);
            values[first + std::size_t(i) * step] = *std::max_element(begin, end);
        }
    };
    for (int y = 0; y < size.y; ++y) along(std::size_t(y) * std::size_t(size.x), size.x, 1);
    for (int x = 0; x < size.x; ++x) along(std::size_t(x), size.y, std::size_t(size.x));
    return values;
}

double seconds_of(std::chrono::steady_clock::time_point since) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - since).count();
}

}  // namespace

struct Reference::State {
    Renderer& renderer;
    ReferenceOptions options;
    ReferenceTarget target;
    Scene scene;
    std::shared_ptr<const LightSampler> light;
    EnvironmentHandle light_of;
    ReferenceProgress progress;
    Place next;                 ///< all replicates have the points before next.first
    int round = 0;              ///< of one slice a replicate
    int judged = 0;             ///< samples at the last judgement
    double wanted = 0.0;        ///< to what pixels are to be known before they rest
    std::vector<float> counts;  ///< as ReferenceTarget's
    int counted = 0;            ///< samples when they were set
    bool round_ended = false;   ///< and nothing was made of it yet
    int rows = 0;               ///< of the picture that have the next slice already
    bool by_clock = false;      ///< its steps follow one
    int gathering = 0;          ///< pixels of the mesh that do, since they were judged
    double work_seconds = 0.0;  ///< of one unit of work, rather more; 0: not known yet
    double slowest = 0.0;       ///< likewise, in the slice that is next: rows differ in how much they show

    int most_at_once() const;
    int count_at_once() const;
    double work_of(int count) const;
    void learn(double seconds_of_work);
    int fewest_rows() const { return (target.size.y + kMostSteps - 1) / kMostSteps; }
    int rows_within(double seconds) const;
    glm::vec2 jitter_px() const;
    void begin();
    void draw(int count);
    bool judgement_due() const;
    void judge();
    void rest(const std::vector<float>& half_widths);
    void end_round();
};

/// Enough rounds that the pixel's area is covered and the scatter can be judged.
int Reference::State::most_at_once() const {
    const int share = std::max(1, options.max_samples / (8 * kReplicates));
    return std::min(share, options.pixel_filter ? kMostAtOnce : kMostOfMiddle);
}

/// Where pixels may rest, later about half as many as there are already, so that it is soon judged and the
/// places in the pixel keep up; by the clock first one, so that there is soon a picture.
int Reference::State::count_at_once() const {
    const int most = most_at_once();
    if (options.tolerance <= 0.0 && !by_clock) return most;
    const auto half = int(std::bit_floor(std::uint32_t(next.first) / 2));
    if (!by_clock || next.first > 16) return std::min(most, std::max(half, 16));
    return std::min(most, next.first == 0 ? 1 : next.first == 1 ? 3 : next.first);
}

/// Shuffled: each place of the pixel is to see all kinds of directions.
glm::vec2 Reference::State::jitter_px() const {
    if (!options.pixel_filter) return glm::vec2(0.0f);
    const std::uint64_t seed = seed_of(options.seed, Pixel);
    const std::uint32_t block = shuffled_index(8 * std::uint32_t(round), seed) / 8;
    const glm::dvec3 u = scrambled_sobol(index_in_hand(block, next.replicate), seed);
    return glm::vec2(glm::dvec2(u.x, u.y) - 0.5);
}

void Reference::State::begin() {
    progress = {};
    round_ended = false;
    round = judged = counted = rows = gathering = 0;
    next = {};
    next.count = count_at_once();
    wanted = std::max(options.tolerance, kFirstTolerance);
    counts.assign(2 * std::size_t(target.size.x) * target.size.y, 0.0f);
    for (std::size_t i = 1; i < counts.size(); i += 2) counts[i] = 1.0f;
    gl::set_reference_counts(target, counts);
    gl::clear_reference(target);
}

/// Those pixels rest around which all that count are known well enough. One that no slice has met the mesh in
/// does not: the next may.
void Reference::State::rest(const std::vector<float>& half_widths) {
    const std::vector<float> around = largest_around(half_widths, target.size);
    const int before = std::exchange(gathering, 0);
    for (std::size_t i = 0; i < half_widths.size(); ++i) {
        const bool is_mesh = half_widths[i] >= 0.0f;
        const bool rests = is_mesh && double(around[i]) <= wanted;
        counts[2 * i + 1] = rests ? 0.0f : 1.0f;
        gathering += is_mesh && !rests ? 1 : 0;
    }
    if (before > 0 && gathering > before) work_seconds *= double(gathering) / before;  // more is wanted now
    gl::set_reference_counts(target, counts);
}

void Reference::State::judge() {
    const std::size_t pixels = counts.size() / 2;
    std::vector<float> samples(pixels);
    for (std::size_t i = 0; i < pixels; ++i)
        samples[i] = counts[2 * i] += counts[2 * i + 1] * float(progress.samples - counted);
    counted = judged = progress.samples;
    const std::vector<float> half_widths = half_widths_of(gl::read_replicates(target), kReplicates, samples);
    double sum = 0.0;
    std::size_t of_mesh = 0;
    for (std::size_t i = 0; i < pixels; ++i)
        if (half_widths[i] >= 0.0f) {
            sum += double(samples[i]);
            ++of_mesh;
        }
    progress.mean_samples = of_mesh == 0 ? double(progress.samples) : sum / double(of_mesh);
    progress.confidence = confidence_of(half_widths);
    progress.converged = progress.confidence->p95 <= options.tolerance;
    if (progress.confidence->p95 <= wanted) wanted = std::max(options.tolerance, 0.5 * wanted);
    round_ended = false;
    progress.done = progress.converged || next.first >= longest_of(options);
    rest(half_widths);
}

bool Reference::State::judgement_due() const {
    const bool last = next.first >= longest_of(options);
    return round_ended &&
           (last || (options.tolerance > 0.0 && round >= 4 && 4 * progress.samples >= 5 * judged));
}

void Reference::State::end_round() {
    ++round;
    round_ended = true;
    next.replicate = 0;
    next.first += next.count;
    next.count = std::min(count_at_once(), longest_of(options) - next.first);
}

Reference::Reference(Renderer& renderer, glm::ivec2 size_px, const ReferenceOptions& options)
    : state_(new State{.renderer = renderer,
                       .options = options,
                       .target = gl::make_reference_target(size_px),
                       .scene = {},
                       .light = {},
                       .light_of = {},
                       .progress = {},
                       .next = {}}) {}

Reference::~Reference() = default;

PanoramaTexels Reference::panorama_of(const EnvironmentHandle& environment) {
    if (!environment) return {1, 1, {glm::vec3(0.0f)}};
    return gl::read_panorama(*environment);
}

void Reference::restart(const Scene& scene, std::shared_ptr<const LightSampler> light) {
    State& state = *state_;
    const auto before = state.light;
    if (light)
        state.light = std::move(light);
    else if (!state.light || state.light_of != scene.environment)
        state.light = std::make_shared<LightSampler>(panorama_of(scene.environment));
    if (state.light != before) gl::set_reference_light(state.target, *state.light);
    state.light_of = scene.environment;
    state.scene = scene;
    state.begin();
}

glm::ivec2 Reference::size_px() const { return state_->target.size; }
const ReferenceProgress& Reference::progress() const { return state_->progress; }
float Reference::share_done() const {
    const ReferenceProgress& progress = state_->progress;
    const double tolerance = state_->options.tolerance;
    const double of_points = double(progress.samples) / state_->options.max_samples;
    if (tolerance <= 0.0 || !progress.confidence) return float(of_points);
    const double missing = std::max(progress.confidence->p95 / tolerance, 1.0);
    return float(std::max(of_points, 1.0 / (missing * missing)));
}

/// So many more rows of the slice that is next, or a judgement.
void Reference::State::draw(int count) {
    if (judgement_due()) {
        judge();
        return;
    }
    round_ended = false;
    if (rows == 0) {
        if (progress.samples == 0 && next.replicate == 0) renderer.prepare_reference(scene, target);
        gl::set_reference_points(target, make_points(*light, next, options));
    }
    const int end = std::min(rows + count, target.size.y);
    const Renderer::ReferenceSlice slice{.replicate = next.replicate,
                                         .points = next.count,
                                         .weight = float(next.count) * kWeightOfOne,
                                         .rows = {rows, end},
                                         .jitter_px = jitter_px()};
    renderer.draw_reference(scene, target, slice);
    rows = end;
    if (rows < target.size.y) return;
    rows = 0;
    progress.samples += next.count;
    if (++next.replicate == kReplicates) end_round();
}

void Reference::draw() {
    State& state = *state_;
    if (!state.progress.done && state.light) state.draw(state.target.size.y);
}

/// Of so many rows of the slice that is next: their points, and as much as three of them for what is found
/// once a row; a slice begins with the whole mesh, which takes as much again.
double Reference::State::work_of(int count) const {
    constexpr double once = 3.0;
    return count * (next.count + once) + (rows == 0 ? target.size.y * once : 0.0);
}

/// A step is to be judged by the slowest rows; the more pixels rest, the less the next slice takes.
void Reference::State::learn(double seconds_of_work) {
    slowest = std::max(slowest, seconds_of_work);
    work_seconds = std::max(work_seconds, slowest);
    if (rows > 0) return;
    work_seconds = std::max(0.8 * work_seconds, slowest);
    slowest = 0.0;
}

/// Of the slice that is next; fewer than fewest_rows() are not worth a step.
int Reference::State::rows_within(double seconds) const {
    if (work_seconds <= 0.0) return 2 * fewest_rows();
    const double fitting = (seconds / work_seconds - work_of(0)) / (work_of(1) - work_of(0));
    return int(std::clamp(fitting, 0.0, double(target.size.y)));
}

void Reference::draw_for(double seconds) {
    State& state = *state_;
    if (!state.light) return;
    state.by_clock = true;
    if (state.progress.samples == 0 && state.rows == 0) state.next.count = state.count_at_once();
    const auto begin = std::chrono::steady_clock::now();
    double before = 0.0, after = 0.0;
    for (bool first = true; !state.progress.done; first = false, before = after) {
        if (!first && state.judgement_due()) return;  // which takes a while, too
        const bool judges = state.judgement_due();
        const int fitting = state.rows_within(seconds - before), fewest = state.fewest_rows();
        if (fitting < fewest && !first) return;
        const int rows = std::min(std::max(fitting, fewest), state.target.size.y - state.rows);
        const double work = state.work_of(rows);
        state.draw(rows);
        gl::wait_for_gpu();
        after = seconds_of(begin);
        if (!judges) state.learn((after - before) / work);
    }
}

void Reference::finish() {
    while (!state_->progress.done) draw();
}

void Reference::write(RenderTarget& target) const {
    const State& state = *state_;
    target.plain = state.scene.view.plain_color;
    const gl::GatheredPoints points{.all = state.progress.samples - state.counted,
                                    .rows = state.rows,
                                    .more = state.rows > 0 ? state.next.count : 0};
    gl::write_reference_mean(state.target, points, kWeightOfOne, target);
    state.renderer.show(state.scene.view, target);
}

Image Reference::inner_pixels() const {
    const glm::ivec2 size = state_->target.size;
    const std::vector<float> values = gl::read_replicates(state_->target);
    const auto covered = [&](int x, int y) {  // rows from the bottom
        if (x < 0 || y < 0 || x >= size.x || y >= size.y) return true;
        for (int k = 0; k < kReplicates; ++k)
            if (!(values[(std::size_t(k) * size.y + y) * size.x + x] > 0.0f)) return false;
        return true;
    };
    Image mask = make_image(size.x, size.y, 1, PixelType::U8);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            bool inside = true;
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx) inside = inside && covered(x + dx, y + dy);
            set_texel(mask, x, size.y - 1 - y, 0, inside ? 1.0f : 0.0f);
        }
    return mask;
}

ReferenceEstimates Reference::estimates() const {
    const State& state = *state_;
    const std::size_t pixels = state.counts.size() / 2;
    const std::vector<float> values = gl::read_replicates(state.target);
    std::vector<float> samples(pixels);
    ReferenceEstimates known;
    known.mean.resize(pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        samples[i] = state.counts[2 * i];
        for (int k = 0; k < kReplicates; ++k) known.mean[i] += values[std::size_t(k) * pixels + i];
        known.mean[i] /= samples[i] * kWeightOfOne;
    }
    known.half_width = half_widths_of(values, kReplicates, samples);
    return known;
}

TargetHandle draw_reference(Renderer& renderer, const Scene& scene, glm::ivec2 size_px,
                            const ReferenceOptions& options) {
    TargetHandle target = renderer.make_target(size_px, 1, TargetPrecision::Full);
    Reference reference(renderer, Renderer::size_px(*target), options);
    reference.restart(scene);
    reference.finish();
    reference.write(*target);
    return target;
}

}  // namespace patina
