// The graphics driver's own cache of compiled shaders, as far as it can end the program.
#pragma once

namespace patina {

/// Mesa maps its cache's index into memory: on a full disk the first write to it ends the program with a bus
/// error. Where little space is left, the driver is told to do without. Call before a context is made.
void keep_driver_off_a_full_disk();

}  // namespace patina
