#include "app/editor.h"

#include "app/editor_loop.h"
#include "app/paths.h"
#include "app/program_store_io.h"
#include "materials/text_io.h"
#include "renderer/core/image_io.h"
#include "ui/workspace.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <exception>
#include <utility>

namespace patina {

namespace fs = std::filesystem;

namespace {

constexpr double kCaretRestsSeconds = 10.0;  ///< without an event: then it stands still
constexpr double kAnimationSeconds = 1.0 / 60.0;

BakeCache bake_cache() { return {.folder = cache_folder() / "ibl"}; }

/// What this thread has worked so far, in milliseconds; where the system does not tell, the time of day.
double thread_work_ms() {
#ifdef CLOCK_THREAD_CPUTIME_ID
    std::timespec now{};
    if (clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now) == 0)
        return double(now.tv_sec) * 1e3 + double(now.tv_nsec) * 1e-6;
#endif
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

WindowOptions window_options(const EditArgs& args, const Settings& settings) {
    WindowOptions options;
    options.size =
        args.window_px.x > 0 ? args.window_px : glm::ivec2(settings.window_width, settings.window_height);
    options.maximized = settings.maximized && args.window_px.x == 0;
    options.driven = !args.drive_script.empty();
    return options;
}

Settings with_arguments(Settings settings, const EditArgs& args) {
    if (!args.mesh.empty()) settings.mesh = args.mesh;
    if (!args.environment.empty()) settings.environment = args.environment;
    return settings;
}

}  // namespace

Loop::Loop(const EditArgs& args, const Registry& registry)
    : args_(args),
      remembered_(load_settings(state_folder())),
      window_(window_options(args, remembered_.settings)),
      jobs_(worker_count(), Window::wake),
      editor_(registry, renderer_, jobs_, with_arguments(remembered_.settings, args), args.skip),
      meter_(renderer_, jobs_) {
    editor_.accuracy_pictures = [this] { return meter_.pictures(); };
    if (!args.drive_script.empty())
        drive_.emplace(load_drive(utf8_to_path(args.drive_script)), args.drive_script);
    editor_.status.renderer = window_.description();
    editor_.status.version = PATINA_VERSION;
    for (const std::string& note : remembered_.notes) log_line(editor_, ui::Severity::Warning, note);
}

/// Where it cannot be had, the editor opens with a new material and says why.
void Loop::open_what_was_named() {
    if (args_.preset.empty() || args_.preset == "-") return;
    try {
        open_file(editor_, find_preset(args_.preset));
    } catch (const std::exception& error) {
        log_line(editor_, ui::Severity::Error, error.what());
    }
}

void Loop::take_events() {
    const WindowEvents events = window_.take_events();
    if (events.any) {
        frames_wanted_ = kFramesAfterEvent;
        event_s_ = window_.time_s();
    }
    if (events.focus_gained) editor_.next_watch_s = 0.0;  // the artist comes back from a paint program
    if (events.close) ask_quit(editor_);
    for (const WindowEvents::Drop& drop : events.drops) {
        if (!drop_) drop_ = ui::Drop{{}, drop.position};
        for (const std::string& file : drop.files) drop_->files.push_back(file);
    }
}

bool Loop::idle() const {
    return frames_wanted_ == 0 && !animating_ && !more_uploads_ && jobs_.running().empty() &&
           !editor_.reconciler.pending() && !editor_.thumbnails.busy() &&
           !jobs_.is_running(editor_.autosave_job) && !drop_ && !wants_refining() && !editor_.sheet.report &&
           !wants_hints();
}

/// Nothing goes on that has to come first.
bool Loop::calm() const {
    return jobs_.running().empty() && !editor_.reconciler.pending() && !editor_.ui.viewport_drag;
}

bool Loop::update_reconciler() {
    std::vector<WantedPicture> further = wanted_pictures(editor_);
    const Document& document = editor_.document;
    if (!document.sheet)
        for (const Shading mode : modes_shown(editor_.ui.accuracy)) {
            further.push_back(
                {document.material, document.mesh, document.environment, document.view, sight()});
            further.back().view.shading = mode;
        }
    int height_px = 1;
    if (editor_.sheet.report) height_px = kReportPx;
    for (const DrawnView& view : sheet_views_)
        if (view.target) height_px = std::max(height_px, Renderer::size_px(*view.target).y);
    for (std::size_t view = 0; document.sheet && view < further.size(); ++view)
        further[view].sight = {camera_of_sheet(editor_, view), height_px};
    return editor_.reconciler.update(editor_.document, editor_.opened, sight(), further);
}

/// Everything that goes on without the interface.
void Loop::think() {
    jobs_.poll();
    const double now_s = window_.time_s();
    more_uploads_ = update_reconciler();
    step_report(editor_);
    if (wants_hints()) step_hints(editor_);
    if (is_seen_) editor_.thumbnails.step(calm());
    watch_files(editor_, now_s);
    keep_work(editor_, now_s);
    settle(editor_, true);
}

/// The first frame has the picture in it; where that takes long, the interface comes before.
bool Loop::awaits_first_picture() const {
    const Reconciler& reconciler = editor_.reconciler;
    return window_.frames() == 0 && !editor_.document.sheet && reconciler.pending() &&
           !reconciler.drawable() && window_.time_s() < began_s_ + kFirstPictureSeconds;
}

bool Loop::needs_frame() const {
    if (!is_seen_ || awaits_first_picture()) return false;
    // What the first picture lacks is uploaded before the interface is drawn once more without it.
    if (!has_drawn_ && more_uploads_ && window_.frames() > 0 && !editor_.document.sheet) return false;
    return frames_wanted_ > 0 || animating_ || window_.time_s() >= redraw_at_s_ ||
           (!editor_.document.sheet && meter_.busy()) || editor_.changes != changes_shown_ ||
           editor_.thumbnails.version() != thumbnails_shown_ || jobs_.running() != jobs_shown_ ||
           editor_.reconciler.pending() != pending_shown_ ||
           (wants_refining() && window_.time_s() - changed_s_ >= kStillSeconds) ||
           (editor_.document.sheet
                ? sheet_is_stale()
                : editor_.reconciler.drawable() &&
                      editor_.reconciler.scene(editor_.camera, editor_.document.view) != drawn_);
}

void Loop::fill_status() {
    ui::Status& status = editor_.status;
    status.jobs.clear();
    for (const Jobs::Status& job : jobs_shown_)
        status.jobs.push_back(
            {.id = job.id, .label = job.label, .progress = job.started ? job.progress : -1.0f});
    if (const auto report = report_line(editor_)) status.jobs.insert(status.jobs.begin(), *report);
    status.title = document_title(editor_.document, editor_.file);
    status.file = path_to_utf8(editor_.file.path);
    status.dirty = is_dirty(editor_.document, editor_.file);
    status.can_undo = editor_.history.can_undo(editor_.document);
    status.can_redo = editor_.history.can_redo(editor_.document);
    status.undo_what = editor_.history.undo_what(editor_.document);
    status.redo_what = editor_.history.redo_what(editor_.document);
    status.frames_rendered = views_;
    const std::string title = status.title + (status.dirty ? " •" : "") + " – Patina";
    if (title != window_title_) window_.set_title(title);
    window_title_ = title;
}

/// What this frame shows: for that no other is drawn.
void Loop::remember_shown() {
    frames_wanted_ = std::max(0, frames_wanted_ - 1);
    changes_shown_ = editor_.changes;
    thumbnails_shown_ = editor_.thumbnails.version();
    jobs_shown_ = jobs_.running();
    pending_shown_ = editor_.reconciler.pending();
    last_frame_s_ = window_.time_s();
}

ui::PanelContext Loop::context_of(ViewBinding& edited) {
    return {.material = editor_.document.material,
            .view = edited.view,
            .camera = edited.camera,
            .mesh = edited.mesh,
            .environment = edited.environment,
            .ui = editor_.ui,
            .browser = editor_.browser,
            .import_sheet = editor_.import_sheet,
            .saved_material = editor_.file.saved,
            .saved_view = editor_.saved_view,
            .home_camera = home_camera_,
            .catalog = editor_.catalog,
            .status = editor_.status,
            .maps = editor_.reconciler.maps(),
            .mesh_info = editor_.reconciler.mesh_info(),
            .environment_info = editor_.reconciler.environment_info(),
            .panels = editor_.registry.panels,
            .scale = window_.interface_scale()};
}

/// A frame that nobody sees, and nothing follows from: it tells how large the picture in the first one is.
void Loop::lay_out() {
    window_.follow_scale();
    ViewBinding view = bind_view(editor_);
    ui::PanelContext context = context_of(view);
    window_.begin_frame();
    ui::draw_workspace(context);
    window_.drop_frame();
    place_px_ = context.result.viewport_size_px;
    laid_out_px_ = window_.framebuffer_px();
}

void Loop::frame() {
    remember_shown();
    window_.follow_scale();
    fill_status();
    fill_thumbnails();

    const ViewBinding bound = bind_view(editor_);
    ViewBinding edited = bound;
    ui::PanelContext context = context_of(edited);
    if (window_.frames() == 0 && laid_out_px_ != window_.framebuffer_px()) lay_out();
    if (!has_drawn_) draw_view(place_px_);  // the first one is seen in this frame, not in the next
    context.sheet = editor_.document.sheet ? &*editor_.document.sheet : nullptr;
    fill_sheet(context);
    fill_viewport(context.viewport);
    fill_probe(context);
    editor_.probe = context.probe;
    if (editor_.ab.map) context.ab_map = {Renderer::texture_of(*editor_.ab.map), false};
    context.maps_status = maps_status(editor_);
    context.work = &renderer_.work();
    context.unsaved = editor_.unsaved ? &*editor_.unsaved : nullptr;
    context.recovery = editor_.recovery_question ? &*editor_.recovery_question : nullptr;
    const std::optional<ui::Drop> drop = std::exchange(drop_, std::nullopt);
    context.drop = drop ? &*drop : nullptr;
    context.recorder = &items_;

    const TargetHandle shown = target_;  // keep their textures alive until the interface is drawn
    const std::vector<DrawnView> shown_sheet = sheet_views_;
    items_.items.clear();
    window_.let_caret_blink(last_frame_s_ - event_s_ < kCaretRestsSeconds);
    window_.begin_frame();
    ui::draw_workspace(context);
    take_binding(editor_, bound, edited, context.result.turn_all_lights);
    after_frame(context);
    const std::optional<fs::path> screenshot = drive_ ? drive_->take_screenshot() : std::nullopt;
    Image picture;
    window_.end_frame(screenshot ? &picture : nullptr);
    if (drew_s_) pace_.took(shown_, window_.time_s() - *std::exchange(drew_s_, std::nullopt));
    ++renderer_.work().frames_shown;
    if (shown && !first_lit_frame_) first_lit_frame_ = {mark_process(), window_.frames() - 1};
    if (screenshot) save_image(*screenshot, picture);
}

void Loop::after_frame(const ui::PanelContext& context) {
    want_thumbnails(context.result);
    carry_out(editor_, context.requests);
    settle(editor_, context.result.item_active || context.result.viewport_active);
    update_reconciler();
    place_px_ = context.result.viewport_size_px;
    if (has_drawn_) draw_view(place_px_);
    measure_view(place_px_, context.result.item_active || context.result.viewport_active);
    draw_sheet(context.result.sheet);
    std::vector<DrawnPhotoView> drawn;
    for (const int seen : sheet_seen_) {
        const DrawnView& shown = sheet_views_[std::size_t(seen)];
        drawn.push_back({std::size_t(seen), shown.has_drawn ? shown.target.get() : nullptr, shown.times});
        update_photo(editor_, drawn.back());
    }
    update_ab(editor_, drawn);
    update_maps(editor_);
    probed_ = context.result.probed;
    animating_ = context.result.wants_redraw;
    redraw_at_s_ = last_frame_s_ + std::min(context.result.redraw_in_s, window_.caret_changes_in_s());
    if (editor_.clipboard) window_.set_clipboard(*std::exchange(editor_.clipboard, std::nullopt));
}

void Loop::drive() {
    if (!drive_) return;
    drive_->step(window_, {.editor = editor_,
                           .items = items_,
                           .idle = idle() && !needs_frame(),
                           .frames = window_.frames(),
                           .views = views_,
                           .turns = turns_,
                           .cpu_ms = 1e3 * process_cpu_s(),
                           .turn_ms = turn_ms_});
    if (drive_->finished()) editor_.quit = true;
}

double Loop::sleep_s() const {
    if (more_uploads_ || report_is_drawn(editor_) || wants_hints() || (drive_ && drive_->busy())) return 0.0;
    if (needs_frame()) return 0.0;
    double wait = next_errand_s(editor_, window_.time_s());
    if (drive_) wait = std::min(wait, drive_->patient_for_s(window_.time_s()));
    if (!is_seen_) return std::max(wait, 0.001);
    if (awaits_first_picture()) wait = std::min(wait, began_s_ + kFirstPictureSeconds - window_.time_s());
    if (wants_refining()) wait = std::min(wait, kStillSeconds);
    if (editor_.thumbnails.busy()) wait = std::min(wait, kAnimationSeconds);
    wait = std::min(wait, redraw_at_s_ - window_.time_s());
    return std::max(wait, 0.001);
}

void Loop::remember_window() {
    Settings& settings = editor_.settings;
    const float scale = window_.interface_scale();
    settings.maximized = window_.maximized();
    if (!settings.maximized) {
        settings.window_width = int(float(window_.size().x) / scale);
        settings.window_height = int(float(window_.size().y) / scale);
    }
    settings.mesh = editor_.document.mesh;
    settings.environment = editor_.document.environment;
    settings.library_width = editor_.ui.library_width;
    settings.inspector_width = editor_.ui.inspector_width;
    settings.drawer_height = editor_.ui.drawer_height;
    settings.show_library = editor_.ui.show_library;
    settings.show_inspector = editor_.ui.show_inspector;
    if (settings == remembered_.settings && remembered_.notes.empty()) return;  // a broken file is replaced
    save_settings(state_folder(), settings);
}

void Loop::live() {
    lay_out();
    while (!editor_.quit) {
        window_.wait(sleep_s());
        const double begin_ms = thread_work_ms();
        window_.require_context();
        drive();
        take_events();
        is_seen_ = !window_.out_of_sight();
        think();
        if (needs_frame()) frame();
        ++turns_;
        turn_ms_ = thread_work_ms() - begin_ms;
    }
}

int Loop::run() {
    began_s_ = window_.time_s();
    fill_catalog(editor_);
    read_presets(editor_);
    open_what_was_named();
    offer_recovery(editor_);
    try {
        live();
    } catch (
        ...) {  // the driver gave up, memory is used up: what the artist did is offered at the next start
        jobs_.end();
        if (has_unsaved_work(editor_)) keep_now(editor_);
        throw;
    }
    jobs_.end();
    editor_.recovery.remove();
    try {
        remember_window();
        write_stats(args_.stats, renderer_.work(), first_lit_frame_);
    } catch (const std::exception& error) {  // closing must not fail for what is only kept
        log_line(editor_, ui::Severity::Warning, error.what());
    }
    return 0;
}

Editor::Editor(const Registry& parts, Renderer& gpu, Jobs& workers, Settings remembered, bool skip)
    : registry(parts),
      renderer(gpu),
      jobs(workers),
      settings(std::move(remembered)),
      document{.mesh = settings.mesh, .environment = settings.environment},
      history(document),
      reconciler(gpu, parts, workers,
                 {.bakes = bake_cache(),
                  .skip = skip,
                  .log = [this](ui::Severity severity,
                                const std::string& text) { log_line(*this, severity, text); }}),
      thumbnails(gpu, parts, workers, {.folder = cache_folder() / "thumbnails", .bakes = bake_cache()}),
      recovery(state_folder()),
      autosave_seen(document) {
    renderer.set_reuse(skip);
    if (skip) renderer.set_program_store(program_store_in(cache_folder() / "programs"));
    ui.library_width = settings.library_width;
    ui.inspector_width = settings.inspector_width;
    ui.drawer_height = settings.drawer_height;
    ui.show_library = settings.show_library;
    ui.show_inspector = settings.show_inspector;
}

int run_editor(const EditArgs& args, const Registry& registry) { return Loop(args, registry).run(); }

}  // namespace patina
