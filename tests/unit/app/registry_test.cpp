#include "app/registry.h"

#include "renderer/core/environment_io.h"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>
#include <string>

namespace patina {
namespace {

TEST(Registry, every_environment_it_lists_is_accepted_by_the_source_that_lists_it) {
    const Registry registry = builtin_parts();
    std::set<std::string> ids;
    for (const EnvironmentSource& source : registry.environments)
        for (const EnvironmentItem& item : source.list()) {
            EXPECT_TRUE(source.accepts(item.id)) << item.id;
            EXPECT_TRUE(ids.insert(item.id).second) << item.id << " is listed twice";
            EXPECT_FALSE(item.title.empty());
            EXPECT_TRUE(item.description.ends_with('.')) << item.description;
        }
    EXPECT_TRUE(ids.contains("studio"));
}

TEST(Registry, lists_blenders_lights_where_blender_is_installed) {
    std::size_t listed = 0;
    for (const EnvironmentSource& source : builtin_parts().environments)
        if (source.name == "blender") listed = source.list().size();
    EXPECT_EQ(listed, list_blender_studio_lights().size());
}

TEST(Registry, an_added_part_is_found_by_name_and_by_extension) {
    Registry registry = builtin_parts();
    registry.meshes.push_back({"dot", "Dot", "A single triangle.", [] {
                                   Mesh mesh;
                                   mesh.name = "dot";
                                   return mesh;
                               }});
    registry.mesh_importers.push_back(
        {"void", "Nothing.", {"void"}, [](const std::filesystem::path&, const std::stop_token& stop) {
             Mesh mesh;
             mesh.name = stop.stop_requested() ? "stopped" : "nothing";
             return mesh;
         }});
    EXPECT_EQ(load_mesh_part(registry, "dot").name, "dot");
    EXPECT_EQ(load_mesh_part(registry, "some/file.VOID").name, "nothing");
    std::stop_source source;
    source.request_stop();
    EXPECT_EQ(load_mesh_part(registry, "file.void", source.get_token()).name, "stopped");
}

TEST(Registry, unknown_names_say_what_there_is) {
    const Registry registry = builtin_parts();
    const auto message = [&](const auto& action) -> std::string {
        try {
            action();
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_NE(message([&] { load_environment(registry, "mars"); }).find("studio"), std::string::npos);
    EXPECT_NE(message([&] { load_mesh_part(registry, "teapot"); }).find("sphere"), std::string::npos);
    EXPECT_NE(message([&] { image_exporter(registry, "a.gif"); }).find(".png"), std::string::npos);
}

}  // namespace
}  // namespace patina
