// How far a mean of independent pictures may be from the truth. Pure.
#pragma once

#include <span>

namespace patina {

/// Student's t for a two-sided 95 % interval of a mean of so many values. Precondition: count ≥ 2.
double student_t95(int count);

/// Over pixels: the half-width of the mean's 95 % interval relative to max(mean, floor), where the floor is a
/// hundredth of the picture's mean. Pixels that are 0 in every replicate do not count.
struct Confidence {
    double median = 0.0;
    double p95 = 0.0;  ///< 95 of 100 pixels are known better
    double max = 0.0;
};
/// values: count pictures one after the other, independent estimates up to a common factor. Precondition:
/// count ≥ 2.
Confidence confidence_of(std::span<const float> values, int count);

}  // namespace patina
