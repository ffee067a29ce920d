// Run time against error of prefiltering, method by method: the measurement behind `patina bench ibl`. Pure
// functions; the caller loads environments, brings threads and writes the results.
#pragma once

#include "renderer/ibl/bake.h"

#include <string>
#include <vector>

namespace patina {

struct IblBenchOptions {
    std::vector<float> roughness = {0.1f, 0.15f, 0.3f, 0.5f, 0.8f, 1.0f};
    std::vector<int> bands = {32, 64, 128, 256, 512};  ///< of transforms cut off there
    std::vector<int> samples = {16,  32,   64,   128,  256,
                                512, 1024, 2048, 4096, 8192};  ///< of filtered importance sampling
    std::vector<int> direct_widths = {64, 128, 256};           ///< of panoramas reduced for brute force
    int repetitions = 3;                                       ///< the median time counts
    int error_texels = 100;                                    ///< see PrefilterProbe
    ParallelFor parallel_for = serial_for;                     ///< for the methods and for the reference
};

/// One level by one method.
struct IblBenchLevel {
    std::string method;  ///< see ibl_bench
    float roughness = 0.0f;
    int face_size = 0;
    double time_ms = 0.0;                    ///< of this level baked alone, with all it needs
    double rms = 0.0, p95 = 0.0, max = 0.0;  ///< relative, against PrefilterReference
    bool on_front = false;  ///< no other method is both faster and more accurate at this roughness
};

struct IblBenchEnvironment {
    std::string id;
    int width = 0;
    int height = 0;
    double peak_over_mean = 0.0;
    double bake_ms = 0.0;  ///< all standard levels and the irradiance
    double first_light_ms = 0.0;
    BakeTimings stages;  ///< of the last of the repeated bakes
    std::vector<IblBenchLevel> levels;
};

/// "transform": what bake_environment gives. "transform N": cut off at degree N. "first light":
/// bake_first_light. "sampling N": N filtered importance samples of a cube map with mipmaps made from the
/// panorama (its making not timed). "direct N": the sum over all texels of the panorama reduced to N columns.
/// Sampling and sums are done for a thousand texels, their time scaled to all of the level. nullopt only when
/// stopped.
std::optional<IblBenchEnvironment> ibl_bench(const Environment& environment, const IblBenchOptions& options,
                                             std::stop_token stop);

/// What a bilinear look-up within a face makes of a level: relative rms against the level at 384² texels.
struct IblFetchError {
    float roughness = 0.0f;
    int face_size = 0;
    double rms = 0.0;
};
std::vector<IblFetchError> ibl_fetch_errors(const Environment& environment,
                                            const std::vector<float>& roughness,
                                            const std::vector<int>& face_sizes,
                                            const ParallelFor& parallel_for);

/// The panorama with that many columns and half as many rows: reduced, or its texels repeated.
Environment ibl_resized(const Environment& environment, int width);

/// Name of the instruction set the transform runs on here.
std::string ibl_instruction_set();

}  // namespace patina
