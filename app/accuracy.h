// What the viewport shows beside the shaded picture: the reference as it gathers, how far the shading is from
// it as a map and in numbers, and what a frame of it costs. Main thread, the renderer's context current.
#pragma once

#include "app/jobs.h"
#include "renderer/core/metrics.h"
#include "renderer/reference.h"
#include "ui/panel_context.h"

#include <memory>
#include <vector>

namespace patina {

/// The modes that are drawn beside the view's own: what they look up has to be in the light, too.
std::vector<Shading> modes_shown(const ui::AccuracySettings& settings);

/// What the last measurement found. Made on a worker.
struct MeasuredError {
    Shading mode = Shading::SplitSum;  ///< that was held against the reference
    int samples = 0;                   ///< of the reference
    PictureError error;
    double mean_flip = 0.0;
    Image relative, flip;                   ///< values; 1 channel, F32
    Image error_map, flip_map, signed_map;  ///< in colours
};
/// To be saved.
struct AccuracyPictures {
    Image radiance, display;  ///< of the reference so far
    int samples = 0;
    std::shared_ptr<const MeasuredError> measured;  ///< nullptr: not yet
};

class AccuracyMeter {
public:
    /// Of the reference a frame: the window answers in between.
    static constexpr double kStepSeconds = 0.08;

    AccuracyMeter(Renderer& renderer, Jobs& jobs);
    ~AccuracyMeter();
    AccuracyMeter(const AccuracyMeter&) = delete;
    AccuracyMeter& operator=(const AccuracyMeter&) = delete;

    /// Once a frame, for what is asked of it: a step of the reference, pictures of other modes, measurements.
    /// held: the artist holds something; while that changes the scene only real-time pictures are drawn.
    void update(const Scene& scene, glm::ivec2 size_px, const ui::AccuracySettings& settings, bool held);
    /// The reference has not come to its end: another frame would draw.
    bool busy() const;
    /// No texture for what is not there yet: the shaded picture stands in.
    ui::Viewport::Picture picture(ui::Layer layer) const;
    /// Where that is drawn; nullptr for maps and what is not there yet.
    const RenderTarget* target(ui::Layer layer) const;
    const ui::AccuracyStatus& status() const;
    /// Nothing while no reference gathers.
    std::shared_ptr<const AccuracyPictures> pictures() const;

private:
    struct State;
    std::shared_ptr<State> state_;
};

}  // namespace patina
