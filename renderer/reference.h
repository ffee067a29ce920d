// The ground truth of a scene: the reflectance integral of shaders/brdf.glsl under the panorama itself at its
// full resolution, gathered over many draws until it stands still. Needs a current context; knows no window,
// no file, no thread.
//
// What is integrated: the same material, maps, shading normals and environment as every other mode; texels of
// the panorama are areas of constant radiance; each pixel averages over its area (a box filter); edges are
// covered by their share. As in the other modes the object neither shadows nor reflects itself, and an
// occlusion map scales the light of the environment, while emission is added as it is.
//
// How: eight replicates grow side by side, dealt out of one Owen-scrambled Sobol sequence, each an unbiased
// estimate; their scatter gives the confidence interval, on the safe side, since together they are more even
// than eight of their own would be. Each slice of a few points sees all pixels at one
// place of their area; what a pixel reflects of the light's cells, by which it draws from them, is found once
// for its middle. Same scene, same options, same bytes. With a tolerance, pixels rest whose whole
// neighbourhood is known well enough, at first to a few percent, in the end to the tolerance: the few that
// need many points get them. Without one all pixels have the same number of points.
#pragma once

#include "renderer/core/confidence.h"
#include "renderer/ibl/light_sampler.h"
#include "renderer/renderer.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace patina {

struct ReferenceOptions {
    int max_samples = 16384;  ///< points a pixel, at which it stops in any case (a multiple of 8)
    double tolerance =
        1e-3;  ///< it stops once 95 of 100 pixels are known better (ConfidenceInterval::p95); 0: never
    bool pixel_filter = true;  ///< false: the middle of each pixel alone
    std::uint64_t seed = 1;
};

struct ReferenceProgress {
    int samples = 0;            ///< points so far of a pixel that never rested
    double mean_samples = 0.0;  ///< of the mesh's pixels, at the last judgement
    std::optional<ConfidenceInterval> confidence;
    bool converged = false;  ///< within the tolerance
    bool done = false;       ///< converged or at the limit
};

/// What is known of each pixel, bottom row first.
struct ReferenceEstimates {
    std::vector<float>
        mean;  ///< of the three channels; of the mesh alone, whose share of the pixel scales it
    std::vector<float> half_width;  ///< of its 95 % interval, as ConfidenceInterval's; negative: no mesh
};

class Reference {
public:
    /// The renderer must outlive it. Throws std::runtime_error where the driver has no room.
    Reference(Renderer& renderer, glm::ivec2 size_px, const ReferenceOptions& options = {});
    ~Reference();
    Reference(const Reference&) = delete;
    Reference& operator=(const Reference&) = delete;

    /// The panorama as the GPU holds it; what a LightSampler is made from, perhaps on a worker.
    static PanoramaTexels panorama_of(const EnvironmentHandle& environment);
    /// Begins anew. light: made from panorama_of(scene.environment); without one it is made here.
    void restart(const Scene& scene, std::shared_ptr<const LightSampler> light = {});
    glm::ivec2 size_px() const;
    const ReferenceProgress& progress() const;
    /// How much of the way to the nearer of its two ends is done, 0…1, as far as can be told: the half-width
    /// falls about as the square root of the points.
    float share_done() const;

    /// One slice; nothing once it is done.
    void draw();
    /// As many rows of slices as fit into that time, by how long those before took; at least a few. The
    /// first slices are of one point, so that there is soon a picture. Waits for the GPU.
    void draw_for(double seconds);
    void finish();  ///< until done

    /// The mean so far and its display picture. target: one sample a pixel, the same size. Precondition:
    /// drawn.
    void write(RenderTarget& target) const;
    /// 1 where the mesh covers a pixel and all around it, else 0: 1 channel, U8, row 0 at the top.
    Image inner_pixels() const;
    /// Precondition: judged, as it is once it is done.
    ReferenceEstimates estimates() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// All at once: a target with the finished reference of a scene.
TargetHandle draw_reference(Renderer& renderer, const Scene& scene, glm::ivec2 size_px,
                            const ReferenceOptions& options);

}  // namespace patina
