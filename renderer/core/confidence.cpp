#include "renderer/core/confidence.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace patina {

double student_t95(int count) {
    // Quantiles at 97.5 % for 1 … 30 degrees of freedom; beyond, Cornish and Fisher's expansion in 1/ν.
    static constexpr double table[] = {12.7062, 4.3027, 3.1824, 2.7764, 2.5706, 2.4469, 2.3646, 2.3060,
                                       2.2622,  2.2281, 2.2010, 2.1788, 2.1604, 2.1448, 2.1314, 2.1199,
                                       2.1098,  2.1009, 2.0930, 2.0860, 2.0796, 2.0739, 2.0687, 2.0639,
                                       2.0595,  2.0555, 2.0518, 2.0484, 2.0452, 2.0423};
    const int freedom = std::max(count - 1, 1);
    if (freedom <= 30) return table[freedom - 1];
    constexpr double z = 1.959964, z3 = z * z * z, z5 = z3 * z * z;
    return z + (z3 + z) / (4.0 * freedom) + (5.0 * z5 + 16.0 * z3 + 3.0 * z) / (96.0 * freedom * freedom);
}

std::vector<float> half_widths_of(std::span<const float> values, int count, std::span<const float> weights) {
    const std::size_t pixels = values.size() / count;
    std::vector<float> half_widths(pixels, -1.0f);
    std::vector<double> means(pixels, 0.0);
    const double t = student_t95(count) / std::sqrt(double(count - 1) * count);
    double total = 0.0;
    std::size_t counted = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
        double mean = 0.0, scatter = 0.0;
        for (int k = 0; k < count; ++k) mean += double(values[k * pixels + i]) / count;
        if (mean == 0.0) continue;
        for (int k = 0; k < count; ++k) {
            const double off = double(values[k * pixels + i]) - mean;
            scatter += off * off;
        }
        const double scale = weights.empty() ? 1.0 : 1.0 / double(weights[i]);
        half_widths[i] = float(scale * t * std::sqrt(scatter));
        total += means[i] = scale * mean;
        ++counted;
    }
    const double floor = counted == 0 ? 1.0 : 0.01 * total / double(counted);
    for (std::size_t i = 0; i < pixels; ++i)
        if (half_widths[i] >= 0.0f) half_widths[i] /= float(std::max(means[i], floor));
    return half_widths;
}

ConfidenceInterval confidence_of(std::vector<float> half_widths) {
    std::erase_if(half_widths, [](float each) { return each < 0.0f; });
    if (half_widths.empty()) return {};
    const auto quantile = [&](double share) {
        const auto at = half_widths.begin() + std::ptrdiff_t(share * double(half_widths.size() - 1));
        std::nth_element(half_widths.begin(), at, half_widths.end());
        return double(*at);
    };
    return {quantile(0.5), quantile(0.95), quantile(1.0)};
}

}  // namespace patina
