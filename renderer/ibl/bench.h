// Run time against error of prefiltering, method by method: the measurement behind `patina bench ibl`. Pure
// functions; the caller loads environments, brings threads and writes the results.
#pragma once

#include "renderer/ibl/bake.h"

#include <string>
#include <vector>

namespace patina {

struct IblBenchOptions {
    std::vector<float> roughness = {0.1f, 0.15f, 0.3f, 0.5f, 0.8f, 1.0f};
    std::vector<int> samples = {16, 64, 256, 1024,
                                4096};      ///< of filtered importance sampling, as the field does it
    int repetitions = 3;                    ///< the median time counts
    int error_texels = 100;                 ///< see PrefilterProbe
    ParallelFor parallel_for = serial_for;  ///< for the methods and for the reference
};

/// One level by one method.
struct IblBenchLevel {
    std::string method;  ///< "transform", "first light", "sampling 1024", "direct 256": see ibl_bench
    float roughness = 0.0f;
    int face_size = 0;
    double time_ms = 0.0;  ///< of this level alone; for the transform its share, see IblBenchEnvironment
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
    BakeTimings stages;  ///< of the median bake
    std::vector<IblBenchLevel> levels;
};

/// "transform": what bake_environment gives. "first light": bake_first_light. "sampling N": N filtered
/// importance samples of a cube map with mipmaps made from the panorama (its making not timed). nullopt only
/// when stopped.
std::optional<IblBenchEnvironment> ibl_bench(const Environment& environment, const IblBenchOptions& options,
                                             std::stop_token stop);

/// Name of the instruction set the transform runs on here.
std::string ibl_instruction_set();

}  // namespace patina
