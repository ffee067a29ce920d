// Runs in the build: writes the split-sum table as C++ on standard output.
#include "renderer/gl/brdf_table.h"
#include "renderer/ibl/brdf_table.h"

#include <cmath>
#include <cstdio>

int main() {
    std::puts("#include \"renderer/gl/brdf_table.h\"\n\nnamespace {\nconstexpr std::uint16_t kTable[] = {");
    const patina::BrdfTable table = patina::bake_end_to_end_brdf_table(patina::kShadingTableSize);
    for (const glm::vec2& ab : table.ab)
        std::printf("%ld,%ld,\n", std::lround(ab.x * 65535.0f), std::lround(ab.y * 65535.0f));
    std::puts("};\n}  // namespace\n\nnamespace patina::embedded {");
    std::puts(
        "std::span<const std::uint16_t> brdf_table() { return kTable; }\n}  // namespace patina::embedded");
    return 0;
}
