// The loop around an Editor: window, views and script. editor.cpp has its turns, editor_views.cpp the
// pictures.
#pragma once

#include "app/accuracy.h"
#include "app/args.h"
#include "app/drive.h"
#include "app/editor_state.h"
#include "app/stats.h"
#include "app/view_pace.h"
#include "app/window.h"

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace patina {

inline constexpr int kFramesAfterEvent =
    3;  ///< the one that shows it, and two in which popups and layouts settle
inline constexpr double kStillSeconds =
    0.2;  ///< without a change before a quick picture is drawn again, well
inline constexpr double kFirstPictureSeconds =
    0.5;  ///< a picture that takes longer to prepare is not in the first frame

/// The loop around an Editor: window, viewport and script.
class Loop {
public:
    Loop(const EditArgs& args, const Registry& registry);
    ~Loop() { jobs_.end(); }  // before the editor that they refer to
    Loop(const Loop&) = delete;
    Loop& operator=(const Loop&) = delete;
    int run();

private:
    void open_what_was_named();
    void live();
    void take_events();
    void think();
    bool awaits_first_picture() const;
    bool needs_frame() const;
    ui::PanelContext context_of(ViewBinding& edited);
    void lay_out();
    void frame();
    void draw_view(glm::ivec2 size_px);
    void draw_sheet(const std::vector<ui::SheetSize>& seen);
    void fill_sheet(ui::PanelContext& context) const;
    bool sheet_is_stale() const;
    Reuse reuse_in_sheet(const Scene& scene, const ui::SheetSize& at,
                         const std::vector<ui::SheetSize>& seen) const;
    Scene sheet_scene(std::size_t view, glm::ivec2 size_px) const;
    bool update_reconciler();
    bool wants_refining() const { return !editor_.document.sheet && has_drawn_ && shown_ != Pace::Good; }
    Sight sight() const;
    void measure_view(glm::ivec2 size_px, bool held);
    void fill_viewport(ui::Viewport& viewport) const;
    void fill_probe(ui::PanelContext& context);
    void remember_shown();
    void fill_status();
    void fill_thumbnails();
    void want_thumbnails(const ui::WorkspaceResult& seen);
    void after_frame(const ui::PanelContext& context);
    void drive();
    double sleep_s() const;
    bool idle() const;
    bool calm() const;
    bool wants_hints() const { return calm() && hints_wanted(editor_); }
    void remember_window();

    const EditArgs& args_;
    ParsedSettings remembered_;
    Window window_;
    Renderer renderer_;
    Jobs jobs_;
    Editor editor_;
    std::optional<Drive> drive_;
    ui::ItemRecorder items_;
    const Camera home_camera_;

    /// A picture and what it was drawn from.
    struct DrawnView {
        TargetHandle target;
        Scene drawn;
        bool has_drawn = false;
        std::uint64_t times = 0;  ///< drawn so far
    };
    AccuracyMeter meter_;
    TargetHandle target_;  ///< what is shown, one of targets_
    std::array<TargetHandle, kPaces> targets_;
    glm::ivec2 size_px_{0};      ///< of the picture on the screen
    glm::ivec2 place_px_{0};     ///< that the last frame had for it
    glm::ivec2 laid_out_px_{0};  ///< of the window, when the picture's place in it was found
    ViewPace pace_{Renderer::is_software()};
    Pace shown_ = Pace::Good;
    double changed_s_ = 0.0;        ///< when the picture was last another one
    std::optional<double> drew_s_;  ///< when this frame's picture was begun
    Scene drawn_;  ///< what the picture was drawn from: it is drawn again when any of this differs
    bool has_drawn_ = false;
    std::vector<DrawnView> sheet_views_;  ///< by the sheet's views
    std::vector<int> sheet_seen_;         ///< those that the last frame showed
    std::uint64_t views_ = 0, turns_ = 0;
    double turn_ms_ = 0.0;  ///< main-thread work of the last turn
    int frames_wanted_ = kFramesAfterEvent;
    bool is_seen_ = true;  ///< the window; out of sight nothing is drawn
    bool animating_ = false;
    bool more_uploads_ = false;
    std::uint64_t changes_shown_ = 0, thumbnails_shown_ = 0;
    std::vector<Jobs::Status> jobs_shown_;
    bool pending_shown_ = false;
    double began_s_ = 0.0;  ///< when the window was there
    double last_frame_s_ = 0.0;
    double event_s_ = 0.0;                                          ///< when something last came from outside
    double redraw_at_s_ = std::numeric_limits<double>::infinity();  ///< of the window's time
    std::optional<FirstLitFrame> first_lit_frame_;
    std::string window_title_;
    std::optional<ui::Drop> drop_;
    std::optional<ui::ProbedPoint> probed_;  ///< where the mouse was in the last frame
};

}  // namespace patina
