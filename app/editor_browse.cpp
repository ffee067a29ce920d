#include "app/editor_state.h"
#include "app/file_dialog.h"
#include "app/paths.h"
#include "app/reconcile_load.h"
#include "materials/params.h"
#include "materials/text_io.h"

#include <algorithm>
#include <exception>

namespace patina {

namespace fs = std::filesystem;

namespace {

/// Where a person would look first for that purpose.
fs::path likely_folder(const Editor& editor) {
    const ui::FileBrowser& browser = editor.browser;
    std::error_code ignored;
    const auto usable = [&](const fs::path& folder) {
        return !folder.empty() && fs::is_directory(folder, ignored);
    };
    if (browser.purpose == ui::BrowserPurpose::LocateMap) {
        const fs::path missing = utf8_to_path(*map_of(editor.document.material, browser.slot).map);
        for (fs::path folder = missing.parent_path(); folder.has_relative_path();
             folder = folder.parent_path())
            if (usable(folder)) return folder;
    }
    fs::path last = utf8_to_path(editor.settings.last_folder);
    if (browser.purpose == ui::BrowserPurpose::SavePreset && !editor.file.path.empty()) {
        fs::path own = editor.file.path.parent_path();
        if (usable(own) && own != share_folder() / "presets") return own;
    }
    if (usable(last)) return last;
    return home_folder();
}

std::string file_name_from(const std::string& title) {
    std::string name = title;
    std::replace_if(
        name.begin(), name.end(),
        [](char c) {
            return static_cast<unsigned char>(c) < 32 ||
                   std::string_view("/\\:*?\"<>|").find(c) != std::string_view::npos;
        },
        '_');
    return name.empty() ? "material" : name;
}

}  // namespace

void list_folder(Editor& editor, const std::string& folder) {
    const bool from_home = folder == "~" || folder.starts_with("~/");
    const FolderListing listing = list_files(
        folder.empty() ? likely_folder(editor)
        : from_home    ? home_folder() / utf8_to_path(folder.substr(std::min(folder.size(), std::size_t{2})))
                       : utf8_to_path(folder));
    ui::FileBrowser& browser = editor.browser;
    browser.folder = listing.folder;
    browser.entries = listing.entries;
    browser.error = listing.error;
    browser.selected.clear();
    std::vector<ui::BrowserPlace> extra{{"Patina's presets", path_to_utf8(share_folder() / "presets")}};
    for (const std::string& file : editor.settings.recent) {
        const fs::path place = utf8_to_path(file).parent_path();
        extra.push_back({path_to_utf8(place.filename()), path_to_utf8(place)});
    }
    browser.places = browser_places(extra);
    if (browser.file_name.empty() && browser.purpose == ui::BrowserPurpose::SavePreset)
        browser.file_name = file_name_from(document_title(editor.document, editor.file)) + ".json";
    if (browser.file_name.empty() && browser.purpose == ui::BrowserPurpose::ExportRender)
        browser.file_name = file_name_from(document_title(editor.document, editor.file)) + ".png";
    const std::string sheet_title = editor.document.sheet ? editor.document.sheet->title : "";
    if (browser.file_name.empty() && browser.purpose == ui::BrowserPurpose::SaveComparison)
        browser.file_name = (sheet_title.empty() ? "comparison" : file_name_from(sheet_title)) + ".json";
    if (browser.file_name.empty() && browser.purpose == ui::BrowserPurpose::ExportReport)
        browser.file_name = (sheet_title.empty() ? "report" : file_name_from(sheet_title)) + ".pdf";
    if (listing.error.empty()) editor.settings.last_folder = listing.folder;
    ++editor.changes;
}

void make_folder(Editor& editor, const std::string& folder) {
    std::error_code failure;
    fs::create_directories(utf8_to_path(folder), failure);
    if (failure)
        log_line(editor, ui::Severity::Error, folder + " cannot be made: " + failure.message() + ".");
    list_folder(editor, failure ? editor.browser.folder : folder);
}

void open_browser(Editor& editor, ui::BrowserPurpose purpose) {
    editor.browser = {.open = true, .purpose = purpose};
    list_folder(editor, "");
}

}  // namespace patina
