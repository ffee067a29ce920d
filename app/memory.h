// How the C library keeps what was freed.
#pragma once

namespace patina {

/// Threads share one heap from now on, so that what one of them has freed serves the others: where each has a
/// heap of its own, what is left of decoding and baking lies idle while the picture is drawn. For commands,
/// which wait for one thing after the other; call before there are threads. Does nothing where the C library
/// has no such choice.
void share_one_heap();

}  // namespace patina
