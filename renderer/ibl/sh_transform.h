// Spherical-harmonic transform of panoramas: analysis to coefficients, synthesis of a zonal convolution onto
// cube faces. Knows no kernels and chooses no bands.
#pragma once

#include "renderer/ibl/bake.h"
#include "renderer/ibl/fft.h"
#include "renderer/ibl/legendre.h"
#include "renderer/ibl/panorama.h"
#include "renderer/ibl/tasks.h"

#include <map>
#include <vector>

namespace patina {

/// L(θ, φ) = Σ_m e^(imφ) Σ_l a_lm P̄_lm(cos θ), θ from +Y, φ = 2πu; the a of −m are the conjugates. Stored for
/// m ≥ 0 as c_l · a_lm (see LegendreTables), at tables.at(l, m): red, green, blue, each real and imaginary.
struct ShCoefficients {
    const LegendreTables* tables = nullptr;
    FloatBuffer values;

    const float* at(int l, int m) const { return values.data() + 6 * tables->at(l, m); }
};

/// Coefficients to the tables' band, every texel taken as an area of constant radiance. Incomplete when
/// stopped.
ShCoefficients analyse(const RadianceView& view, const LegendreTables& tables, const BakeControl& control);

/// E_l = Σ_m |a_lm|², averaged over the channels; Σ_l E_l = ∫L² dω.
std::vector<double> power_spectrum(const ShCoefficients& coefficients);

/// Convolves with zonal kernels and writes cube maps; keeps its memory from one level to the next.
class Synthesis {
public:
    Synthesis(const ShCoefficients& coefficients, const BakeControl& control);

    struct Range {
        glm::vec3 lowest{0.0f}, highest{0.0f};  ///< results are clamped to it, channel by channel
    };
    /// Σ g_l a_lm Y_lm up to the band given by zonal's length, at the texels' centres. Incomplete when
    /// stopped.
    CubeMap to_cube(const std::vector<double>& zonal, int face_size, const Range& range);

private:
    struct Grid {
        int band, rings, columns;  ///< rings from pole to pole, even
    };
    /// Where a face's texels lie on the panorama, in units of its width and height. The bottom mirrors the
    /// top, the sides differ by quarter turns.
    struct FacePositions {
        std::vector<double> side_u, side_v, top_u, top_v;
    };
    void synthesise_orders(const Grid& grid, const std::vector<double>& zonal);
    void synthesise_rows(const Grid& grid);
    void surround(const Grid& grid);
    void resample(const Grid& grid, const Range& range, CubeMap& cube);
    const FacePositions& positions(int face_size);
    float* row(const Grid& grid, int y) const;
    static std::size_t row_floats(const Grid& grid);

    const ShCoefficients& coefficients_;
    const BakeControl& control_;
    std::map<int, FacePositions> positions_;
    FloatBuffer spectrum_, image_;
};

}  // namespace patina
