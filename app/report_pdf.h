// A report as a PDF document, the only door to libharu. Knows no file and no GPU.
#pragma once

#include "app/report.h"

#include <vector>

namespace patina {

/// A4 pages with text that can be searched, pictures and bookmarks. Throws std::runtime_error with one
/// sentence where the library fails. The same report gives the same bytes.
std::vector<unsigned char> to_pdf(const Report& report);

}  // namespace patina
