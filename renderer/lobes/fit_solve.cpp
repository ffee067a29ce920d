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
constexpr int kMost = 18;  ///< parameters of a node: two reflectances, nine each
/// Reflectances fitted at once, and how much each counts. The middle one keeps the mixture by φ honest.
constexpr double kReflectance[] = {1.0, 0.04, 0.2};
constexpr double kCounts[] = {0.4, 0.35, 0.25};
/// Of the mean radiance: no relative error is taken to less. A smaller one lets a few nearly black
/// reflections, where light too much is a hundredfold error and light too little at most all of it, narrow
/// every lobe.
constexpr float kDarkest = 0.2f;

double node_cosine(int i) { return std::max(1e-3, double(i * i) / ((kN - 1) * (kN - 1))); }
double node_roughness(int j) { return brdf::kSharpestFitted + (1.0 - brdf::kSharpestFitted) * j / (kN - 1); }

/// Parameters of one reflectance: {κ, ln ρ} of each tap, weights of the second and third, of the
/// irradiance.
LobeNode to_node(const double* p, int taps) {
    constexpr double per_octave = 1.4426950408889634;
    LobeNode node;
    if (taps == 1) {
        node.one = {float(p[0]), float(p[1] * per_octave)};
        node.one_irradiance = float(p[2]);
    } else {
        for (int t = 0; t < 3; ++t)
            node.three[t] = {float(p[std::ptrdiff_t(2) * t]), float(p[2 * t + 1] * per_octave)};
        node.second_weight = float(p[6]);
        node.third_weight = float(p[7]);
        node.three_irradiance = float(p[8]);
    }
    return node;
}

/// What a node is fitted to: relative light per reflectance, frame and environment.
struct Target {
    double NoV = 1.0;
    double roughness = 1.0;
    double share[3] = {};         ///< φ of each reflectance
    std::vector<Lanes> radiance;  ///< [reflectance · frames + frame]
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
    std::vector<Step> fit(int taps) {
        taps_ = taps;
        per_ = 3 * taps;
        start();
        for (int sweep = 0; sweep < settings_.sweeps; ++sweep) {
            const double easing = sweep < 6 ? 30.0 : sweep < 12 ? 8.0 : 1.0;
            double sum = 0.0;
            for (int k = 0; k < kN * kN; ++k)
                sum += improve(sweep % 2 ? kN * kN - 1 - k : k, settings_.smoothness * easing);
            settings_.progress(taps == 1 ? "one tap" : "three taps", sweep + 1, settings_.sweeps,
                               sum / (kN * kN));
        }
        return nodes_;
    }

private:
    Target make_target(double NoV, double roughness) const {
        Target target{NoV, roughness, {}, {}};
        const Lobe lobe = sample_lobe(NoV, roughness * roughness, settings_.truth_samples);
        std::vector<LobeSums> sums;
        for (const Frame& frame : frames_) sums.push_back(sum_lobe(lobe, light_, frame));
        const glm::vec2 ab(lobe.Ess - lobe.B, lobe.B);
        for (int z = 0; z < 3; ++z) {
            const double f0 = kReflectance[z];
            target.share[z] = brdf::fresnel_share(float(f0), ab);
            const double E = f0 * lobe.Ess + (1.0 - f0) * lobe.B;
            for (const LobeSums& sum : sums) {
                Lanes radiance{};
                add_scaled(radiance, sum.plain, float(f0 / E));
                add_scaled(radiance, sum.fresnel, float((1.0 - f0) / E));
                target.radiance.push_back(radiance);
            }
        }
        return target;
    }

    /// A first guess: Frostbite's dominant direction, a little sharper than the surface; three taps side by
    /// side along the plane of incidence.
    void start() {
        constexpr double kAside[] = {-0.5, 0.7, 2.0}, kNarrower[] = {-0.2, -0.1, 0.1};
        nodes_.assign(std::size_t(kN) * kN, Step{});
        damping_.assign(std::size_t(kN) * kN, 1e-3);
        for (int c = 0; c < kN * kN; ++c) {
            const double r = node_roughness(c / kN), alpha = r * r;
            const double smooth = 1.0 - alpha, turned = 1.0 - smooth * (std::sqrt(smooth) + alpha);
            const double spread = std::min(0.5, alpha + 0.02);
            for (int half = 0; half < 2; ++half) {
                double* p = &nodes_[c][std::size_t(half) * per_];
                for (int t = 0; t < taps_; ++t) {
                    const double aside = taps_ == 1 ? 0.0 : kAside[t] * spread;
                    p[std::ptrdiff_t(2) * t] = std::clamp((0.8 * turned + aside) / alpha, -2.0, 3.0);
                    p[2 * t + 1] = taps_ == 1 ? -0.05 : kNarrower[t];
                }
                if (taps_ == 3) p[6] = p[7] = 0.3;
                p[per_ - 1] = 0.05;
            }
        }
    }

    void residuals(int c, const Step& p, std::vector<float>& out) const {
        const Target& target = targets_[c];
        const int frames = int(frames_.size());
        out.resize(std::size_t(3) * frames * kLanes);
        const float s = float(std::sqrt(1.0 - target.NoV * target.NoV));
        for (int z = 0; z < 3; ++z) {
            Step mixed{};
            for (int k = 0; k < per_; ++k) mixed[k] = p[k] + (p[per_ + k] - p[k]) * target.share[z];
            const LobeNode node = to_node(mixed.data(), taps_);
            const float weight = float(std::sqrt(kCounts[z] / (frames * light_.count)));
            for (int f = 0; f < frames; ++f) {
                const Frame& frame = frames_[f];
                const glm::vec3 R = frame.to_world({-s, 0.0f, float(target.NoV)});
                const Lanes seen =
                    lobe_radiance(light_, node, taps_ == 3, {R, frame.N, float(target.roughness)});
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
        const double widest = 1.0 / (roughness * roughness);
        for (int half = 0; half < 2; ++half) {
            double* q = &p[std::size_t(half) * per_];
            for (int t = 0; t < taps_; ++t) {
                double& turn = q[std::ptrdiff_t(2) * t];
                turn = std::clamp(turn, -std::min(3.0, widest), std::min(4.0, widest));
                const double least = std::log(brdf::kSharpestFitted / roughness) - 0.1;
                q[2 * t + 1] = std::clamp(q[2 * t + 1], std::max(-1.6, least),
                                          std::min(1.0, 0.02 - std::log(roughness)));
            }
            double sum = 0.0;
            for (int k = 2 * taps_; k < per_; ++k) sum += q[k] = std::clamp(q[k], 0.0, 1.0);
            for (int k = 2 * taps_; k < per_ && sum > 1.0; ++k) q[k] /= sum;
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
            const bool kappa = q < 2 * taps_ && q % 2 == 0;
            pull[k] = smoothness * (kappa ? 1.0 : 4.0);
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
            for (int k = 0; k < n; ++k) next[k] += std::clamp(step[k], -0.3, 0.3);
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
    int taps_ = 1;
    int per_ = 3;  ///< parameters of one reflectance
};

}  // namespace

Lanes lobe_radiance(const FitLight& light, const LobeNode& node, bool three, const LobeView& view) {
    const float alpha = view.roughness * view.roughness, log2_roughness = std::log2(view.roughness);
    Lanes sum{};
    const auto add = [&](const LobeTap& tap, float weight) {
        light.add_prefiltered(sum, brdf::tap_direction(view.R, view.N, tap.kappa, alpha),
                              log2_roughness + tap.log2_ratio, weight);
    };
    if (three) {
        add(node.three[0], 1.0f - node.second_weight - node.third_weight - node.three_irradiance);
        add(node.three[1], node.second_weight);
        add(node.three[2], node.third_weight);
        light.irradiance[0].add_to(sum, view.N, node.three_irradiance);
    } else {
        add(node.one, 1.0f - node.one_irradiance);
        light.irradiance[0].add_to(sum, view.N, node.one_irradiance);
    }
    return sum;
}

std::vector<LobePair> fit_lobes(const FitLight& light, const FitSettings& settings) {
    Fitter fitter(light, settings);
    const std::vector<Step> one = fitter.fit(1), three = fitter.fit(3);
    std::vector<LobePair> result;
    for (std::size_t c = 0; c < one.size(); ++c) {
        LobePair pair;
        for (int half = 0; half < 2; ++half) {
            LobeNode node = to_node(&three[c][std::size_t(half) * 9], 3);
            const LobeNode single = to_node(&one[c][std::size_t(half) * 3], 1);
            node.one = single.one;
            node.one_irradiance = single.one_irradiance;
            pair.by_reflectance[half] = node;
        }
        result.push_back(pair);
    }
    return result;
}

}  // namespace patina::lobes
