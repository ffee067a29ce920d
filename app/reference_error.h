// How far a view's shading is from the reference, found a slice a step, so that a window can go on in
// between. Main thread, the renderer's context current.
#pragma once

#include "renderer/core/metrics.h"
#include "renderer/renderer.h"

#include <memory>

namespace patina {

class Reference;

/// On the object, 128 pixels square.
struct ReferenceError {
    PictureError error;
    double flip = 0.0;   ///< mean
    double known = 0.0;  ///< relative 95 % half-width that 95 of 100 pixels of the reference keep
};

/// What that is found from.
struct ReferencePictures {
    Image found, expected;  ///< radiance
    Image mask;             ///< 1 on the object
    double known = 0.0;
};
/// Needs no GPU: a worker may do it.
ReferenceError error_of(const ReferencePictures& pictures);

/// Well below the errors that a report has to show.
inline constexpr double kReferenceKnown = 0.02;

class ReferenceSearch {
public:
    /// It ends once 95 of 100 pixels are known to kReferenceKnown, or after samples: points a pixel, rounded
    /// up to a multiple of 8. The renderer must outlive it.
    ReferenceSearch(Renderer& renderer, int samples);
    ~ReferenceSearch();
    ReferenceSearch(const ReferenceSearch&) = delete;
    ReferenceSearch& operator=(const ReferenceSearch&) = delete;

    void begin(const Scene& scene);
    /// Draws for a moment; false when nothing is left to draw.
    bool step();
    float done() const;  ///< 0…1, as far as can be told
    int samples() const { return samples_; }
    /// Precondition: begun, and step() has said false.
    ReferencePictures result();

private:
    Renderer& renderer_;
    int samples_;
    std::unique_ptr<Reference> reference_;
    Scene scene_;  ///< as it is shaded
};

}  // namespace patina
