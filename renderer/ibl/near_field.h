// Levels too sharp for the transform alone: the lobe's middle by quadrature over the texels around. Knows no
// files, no transform.
#pragma once

#include "renderer/ibl/kernel.h"
#include "renderer/ibl/panorama.h"
#include "renderer/ibl/tasks.h"

#include <vector>

namespace patina {

/// A panorama by colour, its texels repeated where they are so coarse that a texel is no longer flat.
class NearField {
public:
    NearField(const RadianceView& view, const BakeControl& control);

    /// Where a kernel's near part should end for this panorama: sixteen texels away, and far enough for what
    /// is left to need few degrees.
    KernelSplit split() const;

    /// Adds to every texel ∫ L K w dω / ∫ K dω, w the window of the split. Incomplete when stopped.
    void add(double alpha, const KernelSplit& split, CubeMap& cube, const BakeControl& control) const;

private:
    /// sin(a − b) without losing small differences.
    struct Angle {
        double sine = 0.0, cosine = 1.0;
        Angle() = default;
        explicit Angle(double angle);
        double sine_from(const Angle& other) const { return sine * other.cosine - cosine * other.sine; }
    };
    /// A row of texels, or a part of its height.
    struct RowPart {
        int y = 0;
        double height = 0.0;
        Angle half;  ///< θ/2
        double sine = 0.0;
    };
    struct Scratch;
    struct Place;
    struct Sums;
    struct Lobe;
    struct Middle;
    const float* plane(int channel, int y) const;
    double largest_side() const;
    RowPart part_of(int y, int k, int parts) const;
    Place place_of(glm::vec3 N, double outer) const;
    void set_columns(const Place& place, Scratch& scratch) const;
    void add_row(const Place& place, const Lobe& lobe, const RowPart& part, const Scratch& scratch,
                 Sums& sums) const;
    void add_middle(const Place& place, const Lobe& lobe, const Middle& middle, Scratch& scratch,
                    Sums& sums) const;
    Sums sum(const Place& place, const Lobe& lobe, Scratch& scratch) const;

    TexelGrid grid_;
    std::size_t stride_ = 0;
    FloatBuffer planes_;
    std::vector<RowPart> row_;
    std::vector<Angle> edge_;                     ///< half the colatitude between rows
    std::vector<float> half_sine_, half_cosine_;  ///< of half the angle that k columns span, k = −W … W
};

}  // namespace patina
