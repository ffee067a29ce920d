#include "app/stability.h"

#include "app/headless.h"
#include "renderer/renderer.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <iterator>
#include <limits>
#include <numbers>

namespace patina {

std::uint64_t Random::next() {
    state_ += 0x9e3779b97f4a7c15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}
double Random::uniform() { return double(next() >> 11) * 0x1p-53; }
double Random::between(double low, double high) { return low + (high - low) * uniform(); }
double Random::log_between(double low, double high) {
    return std::exp(between(std::log(low), std::log(high)));
}
int Random::below(int count) { return std::min(int(uniform() * count), count - 1); }
bool Random::chance(double probability) { return uniform() < probability; }
glm::dvec3 Random::direction() {
    const double y = between(-1.0, 1.0);
    const double phi = between(0.0, 2.0 * std::numbers::pi);
    const double ring = std::sqrt(std::max(0.0, 1.0 - y * y));
    return {ring * std::sin(phi), y, ring * std::cos(phi)};
}

struct Stage::State {
    HeadlessContext context;
    Renderer renderer;
};
Stage::Stage() = default;
Stage::~Stage() = default;
Renderer& Stage::renderer() {
    if (!state_) state_ = std::make_unique<State>();
    return state_->renderer;
}

void Trial::add(double case_error) {
    ++cases;
    if (std::isnan(case_error)) case_error = std::numeric_limits<double>::infinity();
    error = std::max(error, case_error);
}

std::vector<Property> stability_properties() {
    std::vector<Property> all;
    for (const auto& group :
         {reflection_properties(), light_properties(), mesh_properties(), picture_properties()})
        std::ranges::copy(group, std::back_inserter(all));
    return all;
}

PropertyReport check_property(const Property& property, std::int64_t cases, std::uint64_t first_seed,
                              Stage& stage) {
    PropertyReport report;
    report.worst_seed = first_seed;
    const std::clock_t start = std::clock();
    while (report.cases < std::max<std::int64_t>(cases, 1)) {
        const std::uint64_t seed = first_seed + std::uint64_t(report.trials);
        Random random(seed);
        const Trial trial = property.run(random, stage);
        ++report.trials;
        report.cases += std::max<std::int64_t>(trial.cases, 1);
        if (!(trial.error <= property.tolerance)) ++report.failed_trials;
        if (trial.error <= report.worst) continue;
        report.worst = trial.error;
        report.worst_seed = seed;
    }
    report.seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
    return report;
}

}  // namespace patina
