#include "renderer/ibl/legendre.h"

#include <cmath>
#include <numbers>

namespace patina {

LegendreTables::LegendreTables(int largest_degree, const ParallelFor& parallel_for)
    : band(largest_degree), first(std::size_t(largest_degree) + 2) {
    std::size_t entries = 0;
    for (int m = 0; m <= band + 1; ++m) {
        first[m] = entries;
        entries += std::size_t(band - m + 1 + kPadding);
    }
    factor.assign(entries, 0.0);
    factor_single.assign(entries, 0.0f);
    norm_square.assign(entries, 0.0);
    std::vector<double> diagonal_square = {1.0 / (4.0 * std::numbers::pi)};  // c_m² = (2m + 1)!!/(2m)!!/4π
    for (int m = 1; m <= band; ++m)
        diagonal_square.push_back(diagonal_square.back() * (2.0 * m + 1.0) / (2.0 * m));
    parallel_for(band + 1, [&](int m) { fill_order(m, diagonal_square[m]); });
}

void LegendreTables::fill_order(int m, double diagonal_square) {
    // With ratio = c_(l+1)/c_l: the choice of c says ratio_(l+1) = A_(l+1)/(A_l ratio_l), so f_l =
    // A_(l+1)/ratio_(l+1).
    double square = diagonal_square, a = 1.0, ratio = 1.0;
    norm_square[first[m]] = square;
    for (int l = m; l < band + kPadding - 1; ++l) {
        const double next = l + 1.0;
        const double a_next = std::sqrt((4.0 * next * next - 1.0) / (next * next - double(m) * m));
        const double f = l == m ? 1.0 : a * ratio;
        ratio = a_next / f;
        square *= ratio * ratio;
        a = a_next;
        factor[at(l + 1, m)] = f;
        factor_single[at(l + 1, m)] = float(f);
        norm_square[at(l + 1, m)] = square;
    }
}

GaussNodes::GaussNodes(int count) : x(std::size_t(count)), weight(std::size_t(count)) {
    for (int i = 0; i < (count + 1) / 2; ++i) {
        double z = std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5));
        double slope = 1.0;
        for (int iteration = 0; iteration < 20; ++iteration) {
            double p = 1.0, before = 0.0;
            for (int j = 0; j < count; ++j) {
                const double next = ((2 * j + 1) * z * p - j * before) / (j + 1);
                before = p;
                p = next;
            }
            slope = count * (z * p - before) / (z * z - 1.0);
            z -= p / slope;
            if (std::abs(p / slope) < 1e-15) break;
        }
        x[i] = 0.5 * (1.0 - z);
        x[count - 1 - i] = 0.5 * (1.0 + z);
        weight[i] = weight[count - 1 - i] = 1.0 / ((1.0 - z * z) * slope * slope);
    }
}

}  // namespace patina
