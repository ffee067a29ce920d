#include "renderer/ibl/bench.h"

#include "renderer/ibl/kernel.h"
#include "renderer/ibl/panorama.h"
#include "renderer/ibl/reference.h"
#include "renderer/ibl/sampling.h"
#include "renderer/ibl/sh_simd.h"
#include "renderer/ibl/sh_transform.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace patina {
namespace {

/// The median time of several runs; the last result stays.
template <class Work>
double median_ms(int repetitions, const Work& work) {
    std::vector<double> times;
    for (int i = 0; i < std::max(1, repetitions); ++i) {
        const auto start = std::chrono::steady_clock::now();
        work();
        const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
        times.push_back(time.count());
    }
    std::sort(times.begin(), times.end());
    return times[times.size() / 2];
}

class Bench {
public:
    Bench(const Environment& environment, const IblBenchOptions& options, std::stop_token stop)
        : environment_(environment), options_(options) {
        control_.parallel_for = options.parallel_for;
        control_.stop = std::move(stop);
    }

    std::optional<IblBenchEnvironment> run() {
        result_.id = environment_.id;
        result_.width = environment_.width;
        result_.height = environment_.height;
        const RadianceStatistics s = radiance_statistics(view_of(environment_), serial_for);
        result_.peak_over_mean =
            s.mean > 0.0 ? std::max({s.highest.x, s.highest.y, s.highest.z}) / s.mean : 0.0;
        run_bake();
        const CubePyramid source(environment_, 256, options_.parallel_for);
        for (const float roughness : options_.roughness)
            if (!stopped()) run_level(roughness, source);
        if (!stopped()) run_first_light();
        if (stopped()) return std::nullopt;
        mark_front();
        return result_;
    }

private:
    bool stopped() const { return control_.stop.stop_requested(); }

    void add(const std::string& method, float roughness, int size, double time_ms, PrefilterError e) {
        result_.levels.push_back({method, roughness, size, time_ms, e.rms, e.p95, e.max});
    }
    PrefilterTruth truth_for(const CubeMap& like, float roughness) const {
        return prefilter_truth(like, roughness, environment_,
                               {.texels = options_.error_texels, .parallel_for = options_.parallel_for});
    }

    void run_bake() {
        std::optional<BakedEnvironment> baked;
        result_.bake_ms =
            median_ms(options_.repetitions, [&] { baked = bake_environment(environment_, {}, control_); });
        if (baked) result_.stages = baked->timings;
    }

    void run_level(float roughness, const CubePyramid& source) {
        std::optional<BakedEnvironment> baked;
        const BakeSettings one{.roughness = {roughness}, .face_sizes = {}};
        const double time =
            median_ms(options_.repetitions, [&] { baked = bake_environment(environment_, one, control_); });
        if (!baked) return;
        const CubeMap& cube = baked->levels[0].cube;
        const PrefilterTruth truth = truth_for(cube, roughness);
        add("transform", roughness, cube.size, time, prefilter_error(cube, truth));
        for (const int band : options_.bands)
            if (!stopped()) run_band(band, roughness, truth);
        for (const int samples : options_.samples)
            if (!stopped()) run_sampling(samples, roughness, truth, source);
        for (const int width : options_.direct_widths)
            if (!stopped()) run_direct(width, roughness, truth);
    }

    void run_band(int band, float roughness, const PrefilterTruth& truth) {
        CubeMap cube;
        const double time = median_ms(options_.repetitions, [&] {
            const RadianceView view = view_of(environment_);
            const RadianceStatistics s = radiance_statistics(view, options_.parallel_for);
            const LegendreTables tables(band, options_.parallel_for);
            const ShCoefficients coefficients = analyse(view, tables, control_);
            cube = Synthesis(coefficients, control_)
                       .to_cube(ggx_zonal(double(roughness) * roughness, band), truth.face_size,
                                {s.lowest, s.highest});
        });
        add("transform " + std::to_string(band), roughness, cube.size, time, prefilter_error(cube, truth));
    }

    /// A thousand texels or more: the truth's, again and again.
    static std::vector<glm::vec3> directions_of(const PrefilterTruth& truth) {
        constexpr std::size_t enough = 1000;
        std::vector<glm::vec3> directions;
        const int n = truth.face_size;
        while (directions.size() < enough)
            for (const int texel : truth.texels)
                directions.push_back(cube_texel_direction(n, texel / (n * n), texel % n, texel / n % n));
        return directions;
    }
    static double whole(double time_ms, std::size_t directions, const PrefilterTruth& truth) {
        return time_ms * 6.0 * truth.face_size * truth.face_size / double(directions);
    }

    void run_sampling(int samples, float roughness, const PrefilterTruth& truth, const CubePyramid& source) {
        const std::vector<glm::vec3> directions = directions_of(truth);
        std::vector<glm::vec3> values;
        const double time = median_ms(samples > 1000 ? 1 : options_.repetitions, [&] {
            values = sample_prefiltered(source, roughness, samples, directions, control_);
        });
        add("sampling " + std::to_string(samples), roughness, truth.face_size,
            whole(time, directions.size(), truth), prefilter_error(values, truth));
    }

    void run_direct(int width, float roughness, const PrefilterTruth& truth) {
        const std::vector<glm::vec3> directions = directions_of(truth);
        std::vector<glm::vec3> values(directions.size());
        const Environment small =
            reduce(view_of(environment_), width, std::max(1, width / 2), options_.parallel_for);
        const TexelGrid grid{small.width, small.height};
        std::vector<glm::vec3> towards;
        towards.reserve(small.radiance.size());
        for (int y = 0; y < small.height; ++y)
            for (int x = 0; x < small.width; ++x) towards.emplace_back(grid.direction(x + 0.5, y + 0.5));
        const float alpha2 = roughness * roughness * roughness * roughness;
        const auto one = [&](int k) {
            glm::vec3 sum(0.0f);
            float weights = 0.0f;
            for (int i = 0; i < small.width * small.height; ++i) {
                const float NoL = glm::dot(directions[k], towards[i]);
                if (NoL <= 0.0f) continue;
                const float s = 0.5f * (1.0f - NoL), d = s + alpha2 * (1.0f - s);
                const float weight = NoL / (d * d) * float(grid.area(i / small.width));
                sum += weight * small.radiance[i];
                weights += weight;
            }
            values[k] = weights > 0.0f ? sum / weights : glm::vec3(0.0f);
        };
        const double time = median_ms(1, [&] { options_.parallel_for(int(directions.size()), one); });
        add("direct " + std::to_string(width), roughness, truth.face_size,
            whole(time, directions.size(), truth), prefilter_error(values, truth));
    }

    void run_first_light() {
        const BakeSettings chosen{.roughness = options_.roughness, .face_sizes = {}};
        std::optional<BakedEnvironment> first;
        result_.first_light_ms =
            median_ms(options_.repetitions, [&] { first = bake_first_light(environment_, {}, control_); });
        first = bake_first_light(environment_, chosen, control_);
        if (!first) return;
        for (const PrefilteredLevel& level : first->levels)
            if (!stopped())
                add("first light", level.roughness, level.cube.size, result_.first_light_ms,
                    prefilter_error(level.cube, truth_for(level.cube, level.roughness)));
    }

    void mark_front() {
        for (IblBenchLevel& level : result_.levels)
            level.on_front =
                std::none_of(result_.levels.begin(), result_.levels.end(), [&](const IblBenchLevel& other) {
                    return other.roughness == level.roughness && other.time_ms < level.time_ms &&
                           other.rms < level.rms;
                });
    }

    const Environment& environment_;
    const IblBenchOptions& options_;
    BakeControl control_;
    IblBenchEnvironment result_;
};

}  // namespace

std::optional<IblBenchEnvironment> ibl_bench(const Environment& environment, const IblBenchOptions& options,
                                             std::stop_token stop) {
    return Bench(environment, options, std::move(stop)).run();
}

namespace {

/// Bilinear within a face at (s, t), 0 … 1; nullopt where a neighbouring face would be needed.
std::optional<glm::vec3> fetch(const CubeMap& cube, int face, double s, double t) {
    const double x = s * cube.size - 0.5, y = t * cube.size - 0.5;
    const int x0 = int(std::floor(x)), y0 = int(std::floor(y));
    if (x0 < 0 || y0 < 0 || x0 + 1 >= cube.size || y0 + 1 >= cube.size) return std::nullopt;
    const glm::vec3* texel = &cube.texels[(std::size_t(face) * cube.size + y0) * cube.size + x0];
    const float fx = float(x - x0), fy = float(y - y0);
    return glm::mix(glm::mix(texel[0], texel[1], fx), glm::mix(texel[cube.size], texel[cube.size + 1], fx),
                    fy);
}

double fetch_error(const CubeMap& cube, const CubeMap& fine, float floor) {
    double square = 0.0;
    std::size_t count = 0;
    const int n = fine.size;
    for (int i = 0; i < 6 * n * n; ++i) {
        const auto value = fetch(cube, i / (n * n), (i % n + 0.5) / n, (i / n % n + 0.5) / n);
        if (!value) continue;
        for (int c = 0; c < 3; ++c) {
            const double right = fine.texels[i][c];
            const double error = ((*value)[c] - right) / std::max(right, double(floor));
            square += error * error;
        }
        count += 3;
    }
    return std::sqrt(square / double(count));
}

}  // namespace

std::vector<IblFetchError> ibl_fetch_errors(const Environment& environment,
                                            const std::vector<float>& roughness,
                                            const std::vector<int>& face_sizes,
                                            const ParallelFor& parallel_for) {
    constexpr int fine_size = 384;
    const RadianceStatistics s = radiance_statistics(view_of(environment), parallel_for);
    const auto level = [&](float r, int size) {
        const BakeSettings settings{.roughness = {r}, .face_sizes = {size}, .irradiance = false};
        return bake_environment(environment, settings, {.parallel_for = parallel_for, .stop = {}})
            ->levels[0]
            .cube;
    };
    std::vector<IblFetchError> errors;
    for (const float r : roughness) {
        const CubeMap fine = level(r, fine_size);
        for (const int size : face_sizes)
            errors.push_back({r, size, fetch_error(level(r, size), fine, float(1e-3 * s.mean))});
    }
    return errors;
}

Environment ibl_resized(const Environment& environment, int width) {
    if (width <= environment.width) return reduce(view_of(environment), width, width / 2, serial_for);
    Environment large;
    large.id = environment.id;
    large.width = width;
    large.height = width / 2;
    large.radiance.reserve(std::size_t(large.width) * large.height);
    for (int y = 0; y < large.height; ++y)
        for (int x = 0; x < large.width; ++x)
            large.radiance.push_back(
                environment.radiance[std::size_t(std::int64_t(y) * environment.height / large.height) *
                                         environment.width +
                                     std::size_t(std::int64_t(x) * environment.width / large.width)]);
    return large;
}

std::string ibl_instruction_set() { return simd::instruction_set(); }

}  // namespace patina
