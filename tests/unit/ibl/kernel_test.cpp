#include "renderer/ibl/kernel.h"

#include "renderer/ibl/reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace patina {
namespace {

TEST(Kernel, integrates_to_its_closed_form) {
    for (const double alpha : {1e-4, 1e-3, 0.01, 0.1, 0.5, 0.9, 1.0})
        EXPECT_NEAR(ggx_kernel_integral(alpha) / reference_kernel_integral(alpha), 1.0, 1e-9) << alpha;
}

TEST(Kernel, is_the_cosine_at_full_roughness) {
    // Ramamoorthi and Hanrahan 2001, normalised to A_0 = 1.
    const std::vector<double> g = ggx_zonal(1.0, 40);
    EXPECT_NEAR(g[0], 1.0, 1e-12);
    EXPECT_NEAR(g[1], 2.0 / 3.0, 1e-12);
    double factorials = 0.5;  // l!/(2^l (l/2)!²) for l = 2
    for (int l = 2; l <= 40; ++l) {
        if (l % 2) {
            EXPECT_NEAR(g[l], 0.0, 1e-12) << l;
            continue;
        }
        if (l > 2) factorials *= double(l - 1) / l;
        const double sign = l / 2 % 2 ? 1.0 : -1.0;
        EXPECT_NEAR(g[l], sign * 2.0 * factorials / ((l + 2.0) * (l - 1.0)), 1e-12) << l;
    }
}

TEST(Kernel, falls_with_roughness_down_to_the_ripples_of_its_horizon) {
    std::vector<double> smoother = ggx_zonal(0.01, 200);
    for (const double alpha : {0.02, 0.05, 0.1, 0.3}) {
        const std::vector<double> g = ggx_zonal(alpha, 200);
        for (int l = 1; l <= 200; ++l) {
            EXPECT_LE(std::abs(g[l]), std::abs(smoother[l]) + 1e-5) << alpha << " " << l;
            EXPECT_LE(std::abs(g[l]), 1.0);
        }
        smoother = g;
    }
}

TEST(Kernel, does_not_depend_on_the_band_it_is_asked_for) {
    const std::vector<double> few = ggx_zonal(0.0036, 50), many = ggx_zonal(0.0036, 1000);
    for (int l = 0; l <= 50; ++l) EXPECT_NEAR(few[l], many[l], 1e-11);
}

}  // namespace
}  // namespace patina
