// A software renderer (llvmpipe) compiles a pass that surely fills its pixels in further ways, for whole tiles, and spends several
// times as long on that as on all else. A pass that might discard is spared it; this one discards nothing.
void spare_whole_tiles() {
    if (gl_FragCoord.x < 0.0) discard;
}
