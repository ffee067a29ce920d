#include "app/settings.h"
#include "materials/text_io.h"

#include <exception>

namespace patina {

namespace fs = std::filesystem;

namespace {
constexpr std::size_t kMaxSettingsBytes = 1 << 20;
}

ParsedSettings load_settings(const fs::path& folder) {
    const fs::path file = folder / "settings.json";
    std::error_code ignored;
    if (!fs::exists(file, ignored)) return {};
    try {
        return parse_settings(load_text(file, kMaxSettingsBytes));
    } catch (const std::exception& error) {
        return {.settings = {}, .notes = {error.what()}};
    }
}

void save_settings(const fs::path& folder, const Settings& settings) {
    std::error_code ignored;  // save_text then says what is wrong
    fs::create_directories(folder, ignored);
    save_text(folder / "settings.json", to_json(settings));
}

}  // namespace patina
