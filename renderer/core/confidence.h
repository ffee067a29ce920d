// How far a mean of independent pictures may be from the truth. Pure.
#pragma once

#include <span>
#include <vector>

namespace patina {

/// Student's t for a two-sided 95 % interval of a mean of so many values. Precondition: count ≥ 2.
double student_t95(int count);

/// Over pixels: the half-width of the mean's 95 % interval relative to max(mean, floor), where the floor is a
/// hundredth of the picture's mean. Pixels that are 0 in every replicate do not count.
struct ConfidenceInterval {
    double median = 0.0;
    double p95 = 0.0;  ///< 95 of 100 pixels are known better
    double max = 0.0;
};
/// Of each pixel; negative where it does not count. values: count pictures one after the other, independent
/// estimates up to a common factor; weights: one a pixel, what its values are to be divided by (empty: none).
/// Precondition: count ≥ 2.
std::vector<float> half_widths_of(std::span<const float> values, int count,
                                  std::span<const float> weights = {});
ConfidenceInterval confidence_of(std::vector<float> half_widths);

}  // namespace patina
