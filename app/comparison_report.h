// The report of a comparison: the sheet, photos with their differences, materials with their maps, lights,
// and the commands that make it again.
#pragma once

#include "app/comparison_sheet.h"
#include "app/photo_hints.h"
#include "app/reference_error.h"
#include "app/report.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace patina {

inline constexpr int kReportPx = 640;

struct ComparisonReportOptions {
    std::filesystem::path file;    ///< the comparison's; empty: never saved
    std::filesystem::path output;  ///< of the report; its ending chooses the format
    std::string renderer;          ///< the GL renderer and version that drew it
    int picture_px = kReportPx;    ///< side of a picture
    bool hints = true;             ///< compute what would bring the renders closer to the photos
    int reference_samples = 0;     ///< a pixel; 0: the renders are not held against the reference
};

/// Makes a report view by view, so that a window can go on in between.
class ComparisonReport {
public:
    ComparisonReport(ComparisonScenes& scenes, const Registry& registry, Comparison comparison,
                     ComparisonReportOptions options);

    std::size_t views() const { return places_.size(); }
    std::size_t done() const { return shots_.size() - (unfinished() ? 1 : 0); }
    float progress() const;  ///< 0…1
    /// Loads what the next view shows, draws it, or draws a trial for what is said of the last; false when
    /// all are drawn.
    bool step();
    /// What was drawn, written up. Needs no GPU: a worker may do it.
    Report finish() const;

private:
    struct Shot {
        ViewPlace place;
        std::string material, light;
        Image picture;
        std::shared_ptr<const LoadedPhoto> photo;  ///< null: the view has none
        Image radiance;                            ///< to hold against it
        std::vector<std::string> hints;
        std::optional<ReferencePictures> reference;
    };
    /// What the next view shows, ready to be drawn.
    struct Loaded {
        Scene scene;
        std::shared_ptr<const LoadedPhoto> photo;
    };
    /// Trials are drawn smaller: nine roughnesses and seven colours of every view with a photo.
    glm::ivec2 trial_size() const { return glm::ivec2(std::max(options_.picture_px / 4, 1)); }
    bool unfinished() const { return to_hold_ || hints_ || gathers_; }
    void load_view();
    void draw_view();
    void hold_against_photo();
    void step_hints();
    void step_reference();
    ReportSection sheet() const;
    void add_photos(Report& report) const;
    void add_errors(Report& report) const;
    ReportSection material_section(const std::filesystem::path& file) const;  ///< empty: the default one
    ReportSection lights() const;
    ReportSection making() const;
    std::string render_command(const Shot& shot) const;

    ComparisonScenes& scenes_;
    const Registry& registry_;
    Comparison comparison_;
    ComparisonReportOptions options_;
    std::vector<ViewPlace> places_;
    std::optional<Loaded> loaded_;
    std::vector<Shot> shots_;
    std::optional<Scene> to_hold_;              ///< the last shot's, to be held against its photo
    const RenderTarget* drawn_ = nullptr;       ///< that, drawn
    std::optional<HintSearch> hints_;           ///< of the last shot
    std::optional<ReferenceSearch> reference_;  ///< from the first view on that is held against it
    bool gathers_ = false;                      ///< for the last shot
};

/// Throws std::runtime_error where the name ends neither in .html nor in .pdf, or its folder is not there:
/// before anything is computed.
void require_report_file(const std::filesystem::path& file);
/// By the file's ending; atomic.
void save_report(const std::filesystem::path& file, const Report& report);

}  // namespace patina
