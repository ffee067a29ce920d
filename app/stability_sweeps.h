// What the stability properties and the plots of error against roughness and NoV share: exact values and the
// errors against them.
#pragma once

#include "app/stability.h"

#include <glm/vec2.hpp>
#include <nlohmann/json_fwd.hpp>

namespace patina {

/// How sin²θ of the half vector is had: |N × H|², or the naive 1 − (N·H)².
enum class DistributionForm { Cross, Naive };
/// Relative error of D at one random half vector of the lobe, unit vectors in single precision.
double distribution_error(double roughness, DistributionForm form, Random& random);

/// A and B as the shader reads them: bilinear between the embedded table's 16-bit texels over (√NoV, r).
glm::dvec2 fetched_albedo(double NoV, double roughness);
/// A = ∫ (1 − Fc) f cos θ dω and B likewise with Fc, by a product rule over the visible normals; errs by
/// some 1e-5.
glm::dvec2 exact_albedo(double NoV, double alpha);

/// Errors against roughness and NoV, as {"name", "x", "y", "series": [{"name", "points": [[x, y], …]}]}.
nlohmann::ordered_json stability_sweeps(Stage& stage, bool quick);

}  // namespace patina
