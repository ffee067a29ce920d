// How the C library keeps what was freed.
#pragma once

namespace patina {

/// Threads share one heap from now on, so that what one of them has freed serves the others: where each has a
/// heap of its own, what is left of decoding and baking lies idle while the picture is drawn. It keeps what
/// is freed, up to some MiB, instead of having the system take it and clear it anew. For commands, which wait
/// for one thing after the other; call before there are threads. Does nothing where the C library has no such
/// choice.
void share_freed_memory();

}  // namespace patina
