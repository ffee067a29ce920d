#include "renderer/ibl/level_plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace patina {

int kernel_band(double alpha, int largest) {
    // GGX's coefficients fall like 2αl K₁(2αl), the Hankel transform of α²/(α² + θ²/4)²: at 8.5/α less than
    // 1e-6 is left. However wide the lobe, the kink at its horizon keeps a tail that a small sun in a dark
    // room makes visible.
    constexpr int horizon = 400;
    return std::min(largest, std::max(horizon, int(std::ceil(8.5 / alpha))));
}

void truncate(std::vector<double>& zonal, const std::vector<double>& power, double allowed_rms) {
    constexpr int least = 12;
    double square = 0.0;
    int band = int(zonal.size()) - 1;
    for (; band > least; --band) {
        square += zonal[band] * zonal[band] * power[band] / (4.0 * std::numbers::pi);
        if (square > allowed_rms * allowed_rms) break;
    }
    zonal.resize(std::size_t(band) + 1);
}

}  // namespace patina
