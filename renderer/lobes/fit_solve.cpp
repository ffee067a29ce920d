#include "renderer/lobes/fit_solve.h"

#include "renderer/brdf.h"
#include "renderer/core/least_squares.h"
#include "renderer/lobes/fit_truth.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace patina::lobes {

namespace {

constexpr int kN = kLobeTableSize;
constexpr int kMost = 12;   ///< parameters of a node: two reflectances, six each
constexpr int kPhases = 4;  ///< roughnesses at which a node is fitted
/// Reflectances fitted at once, and how much each counts. The middle one keeps the mixture by φ honest.
constexpr double kReflectance[] = {1.0, 0.04, 0.2};
constexpr double kCounts[] = {0.4, 0.35, 0.25};
/// Of the mean radiance: no relative error is taken to less. A smaller one lets a few nearly black
/// reflections, where light too much is a hundredfold error and light too little at most all of it, narrow
/// every lobe.
constexpr float kDarkest = 0.2f;

/// λ of two levels: a longer lobe would be seen to shorten where one level is looked up alone.
constexpr double kMostSlope = 1.0;

double node_cosine(int i) { return std::max(1e-3, double(i * i) / ((kN - 1) * (kN - 1))); }
double node_roughness(int j) { return std::pow(double(brdf::kSharpestFitted), 1.0 - double(j) / (kN - 1)); }

/// Parameters of one reflectance: log₂(ρ/r), κ at either end of the sweep, w_E; of four levels a₁ and a₂ too.
LobeSweep to_sweep(const double* p, bool four) {
    const double length = four ? 3.0 : 1.0;  ///< in levels
    LobeSweep sweep{float(p[0]), float(0.5 * (p[1] + p[2])), float((p[2] - p[1]) / length), float(p[3])};
    if (four) sweep.lean = {float(p[4]), float(p[5])};
    return sweep;
}

/// What a node is fitted to: relative light per reflectance, frame and environment.
struct Target {
    double NoV = 1.0;
    double roughness = 1.0;  ///< the node's
    struct Phase {
        double roughness = 1.0;
        double share[3] = {};  ///< φ of each reflectance
    };
    std::array<Phase, kPhases> phases;  ///< frame f is seen at roughness f mod kPhases
    std::vector<Lanes> radiance;        ///< [reflectance · frames + frame]
};

using Step = std::array<double, kMost>;

class Fitter {
public:
    Fitter(const FitLight& light, const FitSettings& settings)
        : light_(light), settings_(settings), frames_(spread_frames(settings.frames)) {
        for (int c = 0; c < kN * kN; ++c) {
            targets_.push_back(make_target(node_cosine(c % kN), node_roughness(c / kN)));
            if (c % kN == kN - 1) settings.progress("truth", c + 1, kN * kN, 0.0);
        }
    }

    /// Parameters of every node, F0 = 1 first.
    std::vector<Step> fit(bool four) {
        four_ = four;
        per_ = parameters_of(four);
        start();
        for (int pass = 0; pass < settings_.passes; ++pass) {
            const double easing = pass < 6 ? 30.0 : pass < 12 ? 8.0 : 1.0;
            double sum = 0.0;
            for (int k = 0; k < kN * kN; ++k)
                sum += improve(pass % 2 ? kN * kN - 1 - k : k, settings_.smoothness * easing);
            settings_.progress(four ? "four levels" : "two levels", pass + 1, settings_.passes,
                               sum / (kN * kN));
        }
        return nodes_;
    }

    static int parameters_of(bool four) { return four ? 6 : 4; }

private:
    Target make_target(double NoV, double roughness) const {
        Target target{NoV, roughness, {}, std::vector<Lanes>(3 * frames_.size())};
        for (int k = 0; k < kPhases; ++k) {
            const double levels = (k + 0.5) / kPhases - 0.5;
            target.phases[k].roughness = std::clamp(roughness * std::exp2(levels / brdf::kLevelsPerOctave),
                                                    double(brdf::kSharpestFitted), 1.0);
            add_phase(target, k);
        }
        return target;
    }

    void add_phase(Target& target, int k) const {
        Target::Phase& phase = target.phases[k];
        const Lobe lobe = sample_lobe(target.NoV, phase.roughness * phase.roughness, settings_.truth_samples);
        const glm::vec2 ab(lobe.Ess - lobe.B, lobe.B);
        for (int z = 0; z < 3; ++z) phase.share[z] = brdf::fresnel_share(float(kReflectance[z]), ab);
        for (std::size_t f = k; f < frames_.size(); f += kPhases) {
            const LobeSums sums = sum_lobe(lobe, light_, frames_[f]);
            for (int z = 0; z < 3; ++z) {
                const double f0 = kReflectance[z], E = f0 * lobe.Ess + (1.0 - f0) * lobe.B;
                Lanes& radiance = target.radiance[z * frames_.size() + f];
                add_scaled(radiance, sums.plain, float(f0 / E));
                add_scaled(radiance, sums.fresnel, float((1.0 - f0) / E));
            }
        }
    }

    /// A first guess: Frostbite's dominant direction, a little sharper than the surface; the sharper levels
    /// lie towards R, the wider ones towards N.
    void start() {
        nodes_.assign(std::size_t(kN) * kN, Step{});
        damping_.assign(std::size_t(kN) * kN, 1e-3);
        for (int c = 0; c < kN * kN; ++c) {
            const double r = node_roughness(c / kN), alpha = r * r;
            const double smooth = 1.0 - alpha, turned = 1.0 - smooth * (std::sqrt(smooth) + alpha);
            const double aside = (four_ ? 0.5 : 0.07) * std::min(0.5, alpha + 0.02);
            for (int half = 0; half < 2; ++half) {
                double* p = &nodes_[c][std::size_t(half) * per_];
                p[0] = -0.1;
                p[1] = std::clamp((0.8 * turned - aside) / alpha, -2.0, 3.0);
                p[2] = std::clamp((0.8 * turned + aside) / alpha, -2.0, 3.0);
                p[3] = 0.05;
            }
            bound(r, nodes_[c]);
        }
    }

    void residuals(int c, const Step& p, std::vector<float>& out) const {
        const Target& target = targets_[c];
        const int frames = int(frames_.size());
        out.resize(std::size_t(3) * frames * kLanes);
        const float s = float(std::sqrt(1.0 - target.NoV * target.NoV));
        for (int z = 0; z < 3; ++z) {
            std::array<LobeSweep, kPhases> sweeps;
            for (int phase = 0; phase < kPhases; ++phase) {
                Step mixed{};
                for (int k = 0; k < per_; ++k)
                    mixed[k] = p[k] + (p[per_ + k] - p[k]) * target.phases[phase].share[z];
                sweeps[phase] = to_sweep(mixed.data(), four_);
            }
            const float weight = float(std::sqrt(kCounts[z] / (frames * light_.count)));
            for (int f = 0; f < frames; ++f) {
                const Frame& frame = frames_[f];
                const glm::vec3 R = frame.to_world({-s, 0.0f, float(target.NoV)});
                const float roughness = float(target.phases[f % kPhases].roughness);
                const Lanes seen = lobe_radiance(light_, sweeps[f % kPhases], four_, {R, frame.N, roughness});
                const Lanes& truth = target.radiance[std::size_t(z) * frames + f];
                float* to = &out[(std::size_t(z) * frames + f) * kLanes];
                for (int e = 0; e < kLanes; ++e)
                    to[e] = e < light_.count ? weight * (seen[e] - truth[e]) / std::max(truth[e], kDarkest)
                                             : 0.0f;
            }
        }
    }

    /// The mean of what the neighbours on both sides suggest; at the border, extrapolated with less weight.
    Step suggestion(int c) const {
        Step sum{};
        double total = 0.0;
        const auto at = [&](int i, int j) -> const Step& { return nodes_[j * kN + i]; };
        const int i = c % kN, j = c / kN;
        for (const auto& [di, dj] : {std::pair{1, 0}, {0, 1}}) {
            const bool before = i >= di && j >= dj, after = i + di < kN && j + dj < kN;
            if (before && after) {
                for (int k = 0; k < 2 * per_; ++k)
                    sum[k] += 0.5 * (at(i - di, j - dj)[k] + at(i + di, j + dj)[k]);
                total += 1.0;
            } else {
                const int side = before ? -1 : 1;
                const Step& near = at(i + side * di, j + side * dj);
                const Step& far = at(i + 2 * side * di, j + 2 * side * dj);
                for (int k = 0; k < 2 * per_; ++k) sum[k] += 0.3 * (2.0 * near[k] - far[k]);
                total += 0.3;
            }
        }
        for (double& value : sum) value /= total;
        return sum;
    }

    void bound(double roughness, Step& p) const {
        const double widest = 1.0 / (roughness * roughness), level = 1.0 / brdf::kLevelsPerOctave;
        const double to_sharpest = std::log2(brdf::kSharpestFitted / roughness);
        for (int half = 0; half < 2; ++half) {
            double* q = &p[std::size_t(half) * per_];
            q[0] = std::clamp(q[0], std::max(-2.2, to_sharpest - 2.0 * level),
                              std::min(1.5, level - std::log2(roughness)));
            for (const int end : {1, 2})
                q[end] = std::clamp(q[end], -std::min(3.0, widest), std::min(4.0, widest));
            if (!four_) {
                const double most = 0.5 * kMostSlope, middle = 0.5 * (q[1] + q[2]);
                const double half_length = std::clamp(0.5 * (q[2] - q[1]), -most, most);
                q[1] = middle - half_length;
                q[2] = middle + half_length;
            }
            q[3] = std::clamp(q[3], 0.0, 1.0);
            constexpr double most_lean[] = {4.0, 1.0};  // more of a₂ leaves little of the spline's evenness
            for (int k = 4; k < per_; ++k) q[k] = std::clamp(q[k], -most_lean[k - 4], most_lean[k - 4]);
        }
    }

    /// One step at a node; its rms error after it.
    double improve(int c, double smoothness) {
        const int n = 2 * per_;
        const double roughness = targets_[c].roughness;
        const Step wanted = suggestion(c);
        Step pull{}, h{};
        for (int k = 0; k < n; ++k) {
            const int q = k % per_;
            const bool kappa = q == 1 || q == 2;
            constexpr double stiffness[] = {2.0, 1.0, 1.0, 4.0, 0.3, 0.3};
            pull[k] = smoothness * stiffness[q];
            h[k] = kappa ? std::min(0.1, 2e-3 / (roughness * roughness)) : 1e-3;
        }
        std::vector<float> before;
        residuals(c, nodes_[c], before);
        const auto error2 = [](const std::vector<float>& r) {
            double sum = 0.0;
            for (const float x : r) sum += double(x) * x;
            return sum;
        };
        const auto cost = [&](double error, const Step& p) {
            for (int k = 0; k < n; ++k) error += pull[k] * (p[k] - wanted[k]) * (p[k] - wanted[k]);
            return error;
        };
        double error = error2(before);
        const Normal normal = linearise(c, before, h);
        for (int attempt = 0; attempt < 4; ++attempt) {
            std::array<Step, kMost> a = normal.a;
            Step b{};
            for (int k = 0; k < n; ++k) {
                a[k][k] += pull[k];
                a[k][k] += damping_[c] * (a[k][k] + 1e-4);
                b[k] = -normal.b[k] - pull[k] * (nodes_[c][k] - wanted[k]);
            }
            const Step step = solve_symmetric(a, b, n);
            Step next = nodes_[c];
            for (int k = 0; k < n; ++k) {
                const double most = k % per_ < 4 ? 0.3 : 0.6;
                next[k] += std::clamp(step[k], -most, most);
            }
            bound(roughness, next);
            std::vector<float> after;
            residuals(c, next, after);
            const double reached = error2(after);
            if (cost(reached, next) < cost(error, nodes_[c])) {
                nodes_[c] = next;
                damping_[c] = std::max(1e-5, 0.3 * damping_[c]);
                error = reached;
                break;
            }
            damping_[c] = std::min(1e3, 5.0 * damping_[c]);
        }
        return std::sqrt(error);
    }

    /// JᵀJ and Jᵀr by one-sided differences.
    struct Normal {
        std::array<Step, kMost> a{};
        Step b{};
    };
    Normal linearise(int c, const std::vector<float>& before, const Step& h) const {
        const int n = 2 * per_;
        std::vector<std::vector<float>> columns(n);
        for (int k = 0; k < n; ++k) {
            Step moved = nodes_[c];
            moved[k] += h[k];
            residuals(c, moved, columns[k]);
            for (std::size_t x = 0; x < before.size(); ++x)
                columns[k][x] = float((columns[k][x] - before[x]) / h[k]);
        }
        Normal normal;
        for (int k = 0; k < n; ++k) {
            for (int l = 0; l <= k; ++l) {
                double sum = 0.0;
                for (std::size_t x = 0; x < before.size(); ++x) sum += double(columns[k][x]) * columns[l][x];
                normal.a[k][l] = normal.a[l][k] = sum;
            }
            for (std::size_t x = 0; x < before.size(); ++x) normal.b[k] += double(columns[k][x]) * before[x];
        }
        return normal;
    }

    const FitLight& light_;
    const FitSettings& settings_;
    std::vector<Frame> frames_;
    std::vector<Target> targets_;
    std::vector<Step> nodes_;
    std::vector<double> damping_;
    bool four_ = false;
    int per_ = 4;  ///< parameters of one reflectance
};

}  // namespace

Lanes lobe_radiance(const FitLight& light, const LobeSweep& sweep, bool four, const LobeView& view) {
    const float alpha = view.roughness * view.roughness;
    const float level = FitLight::level_index(std::log2(view.roughness) + sweep.log2_ratio);
    Lanes sum{};
    for (const SweptLevel& each : swept_levels(sweep, level, four))
        if (each.weight > 0.0f)
            light.add_level(sum, brdf::swept_direction(view.R, view.N, each.kappa, alpha), each.level,
                            each.weight);
    light.irradiance[0].add_to(sum, view.N, sweep.irradiance);
    return sum;
}

std::vector<LobePair> fit_lobes(const FitLight& light, const FitSettings& settings) {
    Fitter fitter(light, settings);
    const std::vector<Step> two = fitter.fit(false), four = fitter.fit(true);
    std::vector<LobePair> result(two.size());
    const auto sweep_of = [](const Step& node, std::size_t half, bool is_four) {
        return to_sweep(&node[half * Fitter::parameters_of(is_four)], is_four);
    };
    for (std::size_t c = 0; c < two.size(); ++c)
        for (std::size_t half = 0; half < 2; ++half)
            result[c].by_reflectance[half] = {sweep_of(two[c], half, false), sweep_of(four[c], half, true)};
    return result;
}

}  // namespace patina::lobes
