#include "app/drive.h"

#include "app/paths.h"
#include "materials/text_io.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

namespace patina {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMaxScriptBytes = 1 << 20;
constexpr double kItemPatienceSeconds = 20.0;
constexpr double kPatienceSeconds = 180.0;
constexpr double kTurnSeconds = 0.02;
constexpr int kScrollTries = 120;
constexpr int kDragSteps = 8;

struct Verb {
    const char* name;
    std::size_t min_words, max_words;  ///< after the verb
};
constexpr std::array kVerbs{
    Verb{"click", 1, 4}, Verb{"double-click", 1, 4}, Verb{"right-click", 1, 4}, Verb{"hover", 1, 4},
    Verb{"drag", 3, 3},  Verb{"move", 2, 2},         Verb{"wheel", 1, 1},       Verb{"type", 1, 1},
    Verb{"key", 1, 1},   Verb{"drop", 1, 1000},      Verb{"resize", 2, 2},      Verb{"close", 0, 0},
    Verb{"wait", 1, 4},  Verb{"mark", 0, 0},         Verb{"expect", 1, 3},      Verb{"screenshot", 1, 1},
    Verb{"quit", 0, 0},  Verb{"items", 0, 1},        Verb{"print", 1, 1},       Verb{"hide", 0, 0},
    Verb{"show", 0, 0},
};

/// Blanks separate; double quotes keep them; a '#' outside quotes ends the line. nullopt: a quote is left
/// open.
std::optional<std::vector<std::string>> split_line(const std::string& line) {
    std::vector<std::string> words;
    std::string word;
    bool quoted = false, open = false;
    for (const char c : line) {
        if (c == '"') {
            quoted = !quoted;
            open = true;
        } else if (!quoted && c == '#') {
            break;
        } else if (!quoted && (c == ' ' || c == '\t' || c == '\r')) {
            if (open) words.push_back(std::exchange(word, {}));
            open = false;
        } else {
            word += c;
            open = true;
        }
    }
    if (open) words.push_back(word);
    return quoted ? std::nullopt : std::optional(words);
}

float number(const std::string& word) { return std::strtof(word.c_str(), nullptr); }

std::vector<unsigned> codepoints(const std::string& text) {
    std::vector<unsigned> points;
    for (std::size_t i = 0; i < text.size();) {
        const auto lead = static_cast<unsigned char>(text[i]);
        const std::size_t length = lead < 0x80 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
        unsigned point = length == 1 ? lead : lead & (0xFFu >> (length + 1));
        for (std::size_t k = 1; k < length && i + k < text.size(); ++k)
            point = (point << 6) | (static_cast<unsigned char>(text[i + k]) & 0x3Fu);
        points.push_back(point);
        i += length;
    }
    return points;
}

std::string names_like(const ui::ItemRecorder& items, const std::string& label) {
    std::string names;
    const std::string stem = label.substr(0, label.find('.'));
    for (const auto& [name, item] : items.items)
        if (name.rfind(stem, 0) == 0 && names.size() < 600) names += (names.empty() ? "" : ", ") + name;
    return names.empty() ? "nothing of that kind is there" : "there are " + names;
}

}  // namespace

std::vector<DriveCommand> parse_drive(std::string_view text, const std::string& name) {
    std::vector<DriveCommand> commands;
    std::istringstream stream{std::string(text)};
    int line = 0;
    for (std::string source; std::getline(stream, source);) {
        ++line;
        const auto complain = [&](const std::string& what) {
            std::string sentence = name;
            sentence += ":" + std::to_string(line);
            sentence += ": " + what + ".";
            throw std::runtime_error(sentence);
        };
        const auto words = split_line(source);
        if (!words) complain("a quotation mark is left open");
        if (words->empty()) continue;
        const auto verb = std::find_if(kVerbs.begin(), kVerbs.end(),
                                       [&](const Verb& each) { return (*words)[0] == each.name; });
        if (verb == kVerbs.end()) complain("there is no command '" + (*words)[0] + "'");
        const std::size_t count = words->size() - 1;
        if (count < verb->min_words || count > verb->max_words)
            complain("'" + (*words)[0] + "' has the wrong number of words");
        commands.push_back({line, *words});
    }
    return commands;
}

std::vector<DriveCommand> load_drive(const fs::path& file) {
    return parse_drive(load_text(file, kMaxScriptBytes), path_to_utf8(file));
}

Drive::Drive(std::vector<DriveCommand> commands, std::string name)
    : commands_(std::move(commands)), name_(std::move(name)) {}

void Drive::fail(const std::string& what) const {
    const int line = next_ == 0 ? 0 : commands_[next_ - 1].line;
    throw std::runtime_error(name_ + ":" + std::to_string(line) + ": " + what + ".");
}

void Drive::act(std::function<void(Window&)> action) {
    actions_.emplace_back([this, action = std::move(action)](Window& window, const DriveView& view) {
        action(window);
        frame_to_see_ = view.frames + 1;
        return true;
    });
}

/// Brings the mouse over an item, scrolling its panel if need be.
Drive::Action Drive::reach(const std::string& label, glm::vec2 fraction) {
    return [this, label, fraction, tries = 0](Window& window, const DriveView& view) mutable {
        const ui::RecordedItem* item = view.items.find(label);
        if (!item) {
            if (now_s_ - began_s_ > kItemPatienceSeconds)
                fail("there is no item '" + label + "'; " + names_like(view.items, label));
            return false;
        }
        const ui::Rect& shown = item->visible;
        const bool visible =
            shown.width() > 1.0f && shown.height() > std::min(6.0f, item->rect.height() * 0.6f);
        if (!visible) {
            if (++tries > kScrollTries) fail("'" + label + "' cannot be scrolled into sight");
            const glm::vec2 middle((item->panel.x0 + item->panel.x1) * 0.5f,
                                   (item->panel.y0 + item->panel.y1) * 0.5f);
            const float centre = (item->rect.y0 + item->rect.y1) * 0.5f;
            window.move_mouse(middle);
            window.turn_wheel(centre > middle.y ? -1.0f : 1.0f);
            frame_to_see_ = view.frames + 2;
            return false;
        }
        mouse_ = {shown.x0 + shown.width() * fraction.x, shown.y0 + shown.height() * fraction.y};
        window.move_mouse(mouse_);
        frame_to_see_ = view.frames + 2;  // one to hover, one to settle
        return true;
    };
}

void Drive::begin_pointer(const DriveCommand& command) {
    const auto& words = command.words;
    if (words[0] == "move") {
        mouse_ = {number(words[1]), number(words[2])};
        return act([to = mouse_](Window& window) { window.move_mouse(to); });
    }
    if (words[0] == "wheel")
        return act([lines = number(words[1])](Window& window) { window.turn_wheel(lines); });
    glm::vec2 fraction(0.5f);
    if (words.size() == 5 && words[2] == "at") fraction = {number(words[3]), number(words[4])};
    actions_.push_back(reach(words[1], fraction));
    if (words[0] == "hover") return;
    const int button = words[0] == "right-click" ? 1 : 0;
    const int clicks = words[0] == "double-click" ? 2 : 1;
    if (words[0] == "drag") {
        const glm::vec2 by(number(words[2]), number(words[3]));
        act([](Window& window) { window.press_mouse(0, true); });
        for (int i = 1; i <= kDragSteps; ++i)
            act([this, part = by / float(kDragSteps)](Window& window) { window.move_mouse(mouse_ += part); });
        act([](Window& window) { window.press_mouse(0, false); });
    } else {
        for (int i = 0; i < clicks; ++i) {
            act([button](Window& window) { window.press_mouse(button, true); });
            act([button](Window& window) { window.press_mouse(button, false); });
        }
    }
    act([](Window&) {});
}

void Drive::begin_keys(const DriveCommand& command) {
    const std::string& text = command.words[1];
    if (command.words[0] == "type") {
        act([points = codepoints(text)](Window& window) {
            for (const unsigned point : points) window.type_character(point);
        });
        return act([](Window&) {});
    }
    std::vector<int> keys;
    std::istringstream stream(text == "+" ? "plus" : text);
    for (std::string part; std::getline(stream, part, '+');) {
        const int code = key_code(part);
        if (code == 0) fail("there is no key '" + part + "'");
        keys.push_back(code);
    }
    for (const int key : keys) act([key](Window& window) { window.press_key(key, true); });
    for (auto key = keys.rbegin(); key != keys.rend(); ++key)
        act([code = *key](Window& window) { window.press_key(code, false); });
    act([](Window&) {});
}

void Drive::begin_wait(const DriveCommand& command, const DriveView& view, double now_s) {
    const auto& words = command.words;
    const auto patience = [this](const std::string& what) {
        if (now_s_ - began_s_ > kPatienceSeconds) fail("waited in vain: " + what);
        return false;
    };
    if (words[1] == "idle") {
        actions_.emplace_back([patience](Window&, const DriveView& seen) {
            return seen.idle || patience("the editor is still at work");
        });
    } else if (words[1] == "until") {
        const std::vector<std::string> expectation(words.begin() + 2, words.end());
        actions_.emplace_back([this, patience, expectation](Window&, const DriveView& seen) {
            const std::string mismatch = drive_mismatch(since_mark(seen), expectation);
            return mismatch.empty() || patience(mismatch);
        });
    } else if (words.size() == 3 && words[2].rfind("frame", 0) == 0) {
        actions_.emplace_back(
            [until = view.frames + std::uint64_t(number(words[1]))](Window& window, const DriveView& seen) {
                if (seen.frames < until) window.call_for_frame();
                return seen.frames >= until;
            });
    } else if (words.size() == 3 && words[2].rfind("second", 0) == 0) {
        actions_.emplace_back([this, until = now_s + double(number(words[1]))](Window&, const DriveView&) {
            sleeps_until_s_ = until;
            return now_s_ >= until;
        });
    } else if (words.size() == 3 && words[2].rfind("turn", 0) == 0) {
        actions_.emplace_back([until = view.turns + std::uint64_t(number(words[1]))](
                                  Window&, const DriveView& seen) { return seen.turns >= until; });
    } else {
        fail("wait for what? 'idle', 'N frames', 'N seconds', 'N turns' or 'until …'");
    }
}

DriveView Drive::since_mark(const DriveView& view) const {
    return {.editor = view.editor,
            .items = view.items,
            .idle = view.idle,
            .frames = view.frames - marked_frames_,
            .views = view.views - marked_views_,
            .turns = view.turns - marked_turns_,
            .cpu_ms = view.cpu_ms - marked_cpu_ms_,
            .turn_ms = longest_turn_ms_};
}

void Drive::begin(const DriveCommand& command, Window& window, const DriveView& view) {
    const auto& words = command.words;
    const std::string& verb = words[0];
    if (verb == "key" || verb == "type") return begin_keys(command);
    if (verb == "wait") return begin_wait(command, view, window.time_s());
    if (verb == "drop") {
        std::vector<std::string> files(words.begin() + 1, words.end());
        if (files.size() > 2 && files[files.size() - 2] == "at") {
            actions_.push_back(reach(files.back(), glm::vec2(0.5f)));
            files.resize(files.size() - 2);
        }
        act([files](Window& to) { to.drop_files(files); });
        return act([](Window&) {});
    }
    if (verb == "resize") {
        act([size = glm::ivec2(number(words[1]), number(words[2]))](Window& to) { to.resize(size); });
        return act([](Window&) {});
    }
    if (verb == "hide" || verb == "show") return window.set_shown(verb == "show");
    if (verb == "close") return act([](Window& to) { to.ask_to_close(); });
    if (verb == "mark") {
        marked_frames_ = view.frames;
        marked_views_ = view.views;
        marked_turns_ = view.turns;
        marked_cpu_ms_ = view.cpu_ms;
        longest_turn_ms_ = 0.0;
        return;
    }
    if (verb == "expect") {
        const std::string mismatch = drive_mismatch(since_mark(view), {words.begin() + 1, words.end()});
        if (!mismatch.empty()) fail(mismatch);
        return;
    }
    if (verb == "screenshot") {
        screenshot_ = utf8_to_path(words[1]);
        return act([](Window& to) { to.call_for_frame(); });
    }
    if (verb == "print") {
        const std::optional<std::string> value = drive_value(since_mark(view), words[1]);
        if (!value) fail("there is no value '" + words[1] + "'");
        std::printf("%s=%s\n", words[1].c_str(), value->c_str());
        std::fflush(stdout);  // whoever watches a long script wants to know now
        return;
    }
    if (verb == "items") {
        for (const auto& [name, item] : view.items.items)
            if (words.size() < 2 || name.rfind(words[1], 0) == 0) std::printf("%s\n", name.c_str());
        return;
    }
    if (verb == "quit") {
        finished_ = true;
        return;
    }
    begin_pointer(command);
}

void Drive::step(Window& window, const DriveView& view) {
    now_s_ = window.time_s();
    sleeps_until_s_.reset();
    longest_turn_ms_ = std::max(longest_turn_ms_, view.turn_ms);
    waiting_ = false;
    while (!finished_) {
        if (view.frames < frame_to_see_) {
            window.call_for_frame();  // nothing else may call for the frame that is waited for
            return;
        }
        if (actions_.empty()) {
            if (next_ == commands_.size()) {
                finished_ = true;
                return;
            }
            began_s_ = now_s_;
            const DriveCommand& command = commands_[next_++];
            begin(command, window, view);
            continue;
        }
        const std::uint64_t frame_before = frame_to_see_;
        if (actions_.front()(window, view)) {
            actions_.pop_front();
        } else if (frame_to_see_ == frame_before) {
            waiting_ = true;
            return;
        }
    }
}

double Drive::patient_for_s(double now_s) const {
    return sleeps_until_s_ ? std::max(*sleeps_until_s_ - now_s, 0.0) : kTurnSeconds;
}

std::optional<fs::path> Drive::take_screenshot() { return std::exchange(screenshot_, std::nullopt); }

}  // namespace patina
