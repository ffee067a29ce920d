// The program: words in, exit status out. The last place where an exception is caught.
#include "app/args.h"
#include "app/commands.h"
#include "app/console.h"
#include "app/driver_cache.h"
#include "app/editor.h"
#include "app/memory.h"

#include <cstdio>
#include <exception>

namespace {

int run(const patina::Args& args) {
    using patina::Command;
    const patina::Registry registry = patina::builtin_parts();
    switch (args.command) {
        case Command::Edit:
            return patina::run_editor(args.edit, registry);
        case Command::Render:
            return patina::run_render(args.render, registry);
        case Command::Compare:
            return patina::run_compare(args.render, registry);
        case Command::Report:
            return patina::run_report(args.report, registry);
        case Command::Maps:
            return patina::run_maps(args.maps, registry);
        case Command::Bake:
            return patina::run_bake(args.bake, registry);
        case Command::Bench:
            return patina::run_bench(args.bench, registry);
        case Command::Check:
            return patina::run_check(args.check, registry);
        case Command::List:
            return patina::run_list(args.list, registry);
    }
    return 2;
}

}  // namespace

int main(int argc, char** argv) {
    const patina::ParsedArgs parsed = patina::parse_args({argv + 1, argv + argc});
    if (!parsed.args) {
        std::fputs(parsed.message.c_str(), parsed.exit_status == 0 ? stdout : stderr);
        return parsed.exit_status;
    }
    try {
        patina::keep_driver_off_a_full_disk();
        if (parsed.args->command != patina::Command::Edit) patina::share_freed_memory();
        return run(*parsed.args);
    } catch (const std::exception& error) {
        patina::say(error.what());
        return 1;
    }
}
