// Text for XML, SVG and HTML.
#pragma once

#include <string>
#include <string_view>

namespace patina {

/// One line of text between tags or quotes; control characters become spaces.
std::string xml_escaped(std::string_view text);

}  // namespace patina
