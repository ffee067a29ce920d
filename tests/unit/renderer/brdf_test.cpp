// The distribution that is left of GGX where half vectors are spread, against what it stands for.
#include "renderer/brdf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace patina {
namespace {

struct Width {
    float alpha, spread;
};
constexpr Width kWidths[] = {{0.0064f, 0.0f}, {0.0064f, 1e-5f}, {0.0064f, 1e-4f}, {0.0064f, 2e-3f},
                             {0.03f, 1e-3f},  {0.03f, 1e-2f},   {0.2f, 0.01f},    {0.2f, 0.1f}};

float spread_at(const Width& w, double slope2) {
    const double sin2 = slope2 / (1.0 + slope2);
    return brdf::distribution_spread(float(sin2), w.alpha * w.alpha, w.spread);
}
/// Density over slopes: D cos⁴θ.
double slope_density(const Width& w, double slope2) {
    return double(spread_at(w, slope2)) / std::pow(1.0 + slope2, 2.0);
}

/// ∫ f(t) dt from 0, in steps of equal ratio.
template <class F>
double integral(const F& f) {
    double sum = 0.0, last = 0.0;
    for (double t = 1e-9; t < 1e3; t *= 1.01) {
        sum += f(0.5 * (t + last)) * (t - last);
        last = t;
    }
    return sum;
}

TEST(SpreadDistribution, keeps_all_light) {
    for (const Width& w : kWidths)
        EXPECT_NEAR(integral([&](double t) { return std::numbers::pi * slope_density(w, t); }), 1.0, 3e-3)
            << w.alpha << " " << w.spread;
}

TEST(SpreadDistribution, has_the_tails_of_the_lobe_that_is_spread) {
    for (const Width& w : kWidths) {
        const double far = 400.0 * (double(w.spread) + double(w.alpha) * w.alpha);
        const Width plain{w.alpha, 0.0f};
        EXPECT_NEAR(slope_density(w, far) / slope_density(plain, far), 1.0, 0.02)
            << w.alpha << " " << w.spread;
    }
}

TEST(SpreadDistribution, is_as_high_as_the_convolution_with_a_blob) {
    for (const Width& w : kWidths) {
        if (w.spread == 0.0f) continue;
        const Width plain{w.alpha, 0.0f};
        const double height = integral(
            [&](double t) { return slope_density(plain, t) * std::exp(-t / double(w.spread)) / w.spread; });
        EXPECT_NEAR(slope_density(w, 0.0) / height, 1.0, 0.07) << w.alpha << " " << w.spread;
    }
}

}  // namespace
}  // namespace patina
