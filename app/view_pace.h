// How well the picture is drawn while it moves: on a machine where the good one takes too long, a quicker one
// until it is still. Knows no window and no clock.
#pragma once

#include <glm/vec2.hpp>

#include <algorithm>
#include <array>

namespace patina {

enum class Pace {
    Good,
    Quick,  ///< one sample a pixel
    Rough   ///< and half as many pixels each way
};
inline constexpr int kPaces = 3;

/// Of a picture that is shown at size_px.
inline glm::ivec2 drawn_px(Pace pace, glm::ivec2 size_px) {
    return pace == Pace::Rough ? (size_px + 1) / 2 : size_px;
}
inline int samples_a_pixel(Pace pace) { return pace == Pace::Good ? 4 : 1; }

class ViewPace {
public:
    ViewPace() = default;
    /// Software is taken for slow until it has shown how fast it is: the first picture does not wait for
    /// that.
    explicit ViewPace(bool is_software) {
        if (is_software) seconds_ = {kSlowInSoftware, kSlowInSoftware, 0.0};
    }
    /// A frame with such a picture took so long. A good picture is drawn when all is still: then a quick one
    /// that was slow (the driver compiled a shader) gets another try after a while.
    void took(Pace quality, double seconds) {
        seconds_[int(quality)] = seconds;
        if (quality == Pace::Good) seconds_[int(Pace::Quick)] *= 0.5;
    }
    /// The best one that is quick enough; what was never tried counts as quick.
    Pace while_moving() const {
        const auto* const found = std::find_if(seconds_.begin(), seconds_.end() - 1,
                                               [](double each) { return each <= kSlowSeconds; });
        return Pace(found - seconds_.begin());
    }

private:
    static constexpr double kSlowSeconds = 0.04;  ///< longer than this does not feel like moving
    static constexpr double kSlowInSoftware = 2.0 * kSlowSeconds;  ///< until the first good picture halves it
    std::array<double, kPaces> seconds_{};                         ///< of the last one
};

}  // namespace patina
