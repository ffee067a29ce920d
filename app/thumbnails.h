// Small pictures of presets, environments and meshes for the library: made one at a time when nothing else is
// to be done, kept on disk by content. Main thread only; knows no interface and no window.
#pragma once

#include "app/jobs.h"
#include "app/registry.h"
#include "renderer/ibl/cache.h"
#include "renderer/renderer.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace patina {

class Thumbnails {
public:
    struct Options {
        std::filesystem::path folder;  ///< of the disk cache
        BakeCache bakes;
        BakeSettings bake_settings = drawing_bake_settings();
    };
    enum class Kind { Preset, Environment, Mesh, Picture };

    Thumbnails(Renderer& renderer, const Registry& registry, Jobs& jobs, Options options);
    ~Thumbnails();
    Thumbnails(const Thumbnails&) = delete;
    Thumbnails& operator=(const Thumbnails&) = delete;

    /// The texture's name, or 0 while there is none.
    std::uintptr_t texture(Kind kind, const std::string& id) const;
    /// It is to be made, unless it was already.
    void want(Kind kind, const std::string& id);
    /// The file changed: make it again (the old one is shown meanwhile).
    void forget(Kind kind, const std::string& id);
    /// Takes the next step if nothing else is to be done. True if it drew something now.
    bool step(bool nothing_else_to_do);
    /// Grows with every picture that has come.
    std::uint64_t version() const;
    bool busy() const;  ///< something asked for is not there yet

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace patina
