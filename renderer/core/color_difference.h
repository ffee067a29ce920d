// How different two colours look: CIE Lab and CIEDE2000. Pure.
#pragma once

#include <glm/vec3.hpp>

namespace patina {

/// Relative luminance of a scene-linear colour with Rec. 709 primaries (Y of D65 white = 1).
float luminance(glm::vec3 linear);

/// CIE L*a*b* (D65 white) of a scene-linear colour with Rec. 709 primaries; the paper white is (1,1,1).
glm::vec3 lab_of(glm::vec3 linear);

/// CIEDE2000 with kL = kC = kH = 1 (Sharma, Wu, Dalal: The CIEDE2000 color-difference formula, Color Res.
/// Appl. 2005). About 1 is just noticeable side by side.
float delta_e_2000(glm::vec3 lab_a, glm::vec3 lab_b);

}  // namespace patina
