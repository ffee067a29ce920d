// The inner loop of the BRDF table, compiled for several instruction sets like sh_simd.h.
#pragma once

namespace patina::simd {

/// Nodes on the cap of visible normals; count is a multiple of kAlbedoNodes, the surplus weightless.
inline constexpr int kAlbedoNodes = 16;
struct AlbedoNodes {
    int count = 0;
    const float* height = nullptr;  ///< 0 at the top of the cap, 1 at its rim
    const float* cos_phi = nullptr;
    const float* sin_phi = nullptr;
    const float* weight = nullptr;  ///< sums to 1
};
/// One view direction and roughness.
struct AlbedoView {
    float NoV;  // NOLINT(readability-identifier-naming): the literature's letter
    float sin_v, alpha;
    float vx, vz;  ///< the view stretched by alpha, unit
    float cap;     ///< height of the cap: z from 1 − cap to 1
    float lambda_v;
};
/// Means over the nodes of G2/G1 · (1 − Fc) and G2/G1 · Fc.
void directional_albedo(const AlbedoNodes& nodes, const AlbedoView& view, float* scale, float* bias);

}  // namespace patina::simd
