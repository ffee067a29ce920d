#include "materials/map_naming.h"

#include "materials/map_words.h"
#include "materials/params.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace patina {

namespace {

ImportProposal proposed(const std::vector<std::string>& files) { return propose_import(files); }

std::string use_text(const ImportRow& row) {
    if (!row.slot) return "-";
    std::string text(slot_row(*row.slot).key);
    if (*row.slot == MapSlot::Roughness || *row.slot == MapSlot::Metallic || *row.slot == MapSlot::Ao)
        text += "." + std::string(choice(kChannels, row.channel).id) + (row.invert ? " inverted" : "");
    if (*row.slot == MapSlot::Normal)
        text += " " + std::string(choice(kNormalConventions, row.convention).id);
    if (*row.slot == MapSlot::Albedo || *row.slot == MapSlot::Emission)
        text += " " + std::string(choice(kColorSpaces, row.color_space).id);
    return text;
}
/// "albedo srgb", "roughness.g", "ao.r + roughness.g", "-": all uses of one file.
std::string use_of(const std::vector<std::string>& files, const std::string& file) {
    std::string text;
    for (const ImportRow& row : proposed(files).rows)
        if (row.file == file && row.slot) text += (text.empty() ? "" : " + ") + use_text(row);
    return text.empty() ? "-" : text;
}
std::string use_of(const std::string& file) { return use_of({file, "other_set/readme_x.png"}, file); }
std::string reasons_of(const std::vector<std::string>& files, const std::string& file) {
    std::string text;
    for (const ImportRow& row : proposed(files).rows)
        if (row.file == file) text += row.reason + "|";
    return text;
}
/// What a set comes to: slot → file and how it is read.
std::map<std::string, std::string> slots_of(const std::vector<std::string>& files) {
    std::map<std::string, std::string> slots;
    for (const ImportRow& row : proposed(files).rows)
        if (row.slot) slots[use_text(row)] = row.file;
    return slots;
}
using Slots = std::map<std::string, std::string>;

}  // namespace

TEST(MapNaming, knows_ambientcg) {
    EXPECT_EQ(
        slots_of({"Metal014_4K-PNG_Color.png", "Metal014_4K-PNG_NormalGL.png", "Metal014_4K-PNG_NormalDX.png",
                  "Metal014_4K-PNG_Roughness.png", "Metal014_4K-PNG_Metalness.png",
                  "Metal014_4K-PNG_Displacement.png", "Metal014_4K-PNG_AmbientOcclusion.png",
                  "Metal014_4K-PNG_Opacity.png", "Metal014_4K-PNG_Emission.png", "Metal014_4K-PNG.blend",
                  "Metal014_4K-PNG.mtlx", "Metal014.png"}),
        (Slots{{"albedo srgb", "Metal014_4K-PNG_Color.png"},
               {"normal opengl", "Metal014_4K-PNG_NormalGL.png"},
               {"roughness.r", "Metal014_4K-PNG_Roughness.png"},
               {"metallic.r", "Metal014_4K-PNG_Metalness.png"},
               {"ao.r", "Metal014_4K-PNG_AmbientOcclusion.png"},
               {"emission srgb", "Metal014_4K-PNG_Emission.png"}}));
}

TEST(MapNaming, names_the_set_without_resolution_and_format) {
    EXPECT_EQ(proposed({"Metal014_4K-PNG_Color.png", "Metal014_4K-PNG_Roughness.png"}).name, "Metal014");
    EXPECT_EQ(proposed({"x/metal_plate_diff_1k.jpg", "x/metal_plate_rough_1k.jpg"}).name, "metal plate");
    EXPECT_EQ(proposed({"scans/helmet/albedo.jpg"}).name, "helmet");
}

TEST(MapNaming, knows_poly_haven) {
    EXPECT_EQ(slots_of({"metal_plate_diff_1k.jpg", "metal_plate_nor_gl_1k.exr", "metal_plate_nor_dx_1k.exr",
                        "metal_plate_rough_1k.exr", "metal_plate_disp_1k.png", "metal_plate_metal_1k.exr",
                        "metal_plate_ao_1k.jpg", "metal_plate_spec_1k.jpg"}),
              (Slots{{"albedo srgb", "metal_plate_diff_1k.jpg"},
                     {"normal opengl", "metal_plate_nor_gl_1k.exr"},
                     {"roughness.r", "metal_plate_rough_1k.exr"},
                     {"metallic.r", "metal_plate_metal_1k.exr"},
                     {"ao.r", "metal_plate_ao_1k.jpg"}}));
    EXPECT_EQ(use_of("rusty_gate_arm_2k.jpg"), "roughness.g + metallic.b + ao.r");
    EXPECT_EQ(use_of("plank_rough_ao_16k.png"), "roughness.g + ao.r");
}

TEST(MapNaming, knows_substance_sampler) {
    for (const char* word : {"basecolor", "color", "albedo", "base_color", "base", "col", "colour",
                             "base_colour", "basecolour", "diffuse", "diff"})
        EXPECT_EQ(use_of(std::string("oak_") + word + ".png"), "albedo srgb") << word;
    for (const char* word : {"ambientocclusion", "ao", "occlusion", "ambient_occlusion"})
        EXPECT_EQ(use_of(std::string("oak_") + word + ".png"), "ao.r") << word;
    for (const char* word : {"metallic", "mtl", "metalness"})
        EXPECT_EQ(use_of(std::string("oak_") + word + ".png"), "metallic.r") << word;
    for (const char* word : {"normal", "nrm"})
        EXPECT_EQ(use_of(std::string("oak_") + word + ".png"), "normal opengl") << word;
    for (const char* word : {"roughness", "rough"})
        EXPECT_EQ(use_of(std::string("oak_") + word + ".png"), "roughness.r") << word;
    for (const char* word : {"glossiness", "gloss"})
        EXPECT_EQ(use_of(std::string("oak_") + word + ".png"), "roughness.r inverted") << word;
    EXPECT_EQ(use_of("oak_emissive.png"), "emission srgb");
}

TEST(MapNaming, recognises_what_this_material_does_not_use_and_says_why) {
    const struct {
        const char *word, *why;
    } cases[] = {{"height", "height map"},
                 {"heightmap", "height map"},
                 {"displacement", "height map"},
                 {"disp", "height map"},
                 {"Height_Map", "height map"},
                 {"dsp", "height map"},
                 {"displace", "height map"},
                 {"bump", "height map"},
                 {"bmp", "height map"},
                 {"opacity", "opacity map"},
                 {"alpha", "opacity map"},
                 {"specular", "specular map"},
                 {"spec", "specular map"},
                 {"Cavity", "cavity"},
                 {"translucent", "layer"},
                 {"ClearcoatRoughness", "layer"},
                 {"ObjectSpaceNormal", "whole object"},
                 {"preview", "preview picture"},
                 {"Thumb", "preview picture"},
                 {"ColorID", "regions"}};
    for (const auto& [word, why] : cases) {
        const std::string file = std::string("oak_2k_") + word + ".png";
        EXPECT_EQ(use_of(file), "-") << word;
        EXPECT_NE(reasons_of({file}, file).find(why), std::string::npos) << reasons_of({file}, file);
    }
}

TEST(MapNaming, knows_substance_painter) {
    EXPECT_EQ(slots_of({"crate_Body_BaseColor.png", "crate_Body_Roughness.png", "crate_Body_Metallic.png",
                        "crate_Body_Normal.png", "crate_Body_Height.png"}),
              (Slots{{"albedo srgb", "crate_Body_BaseColor.png"},
                     {"roughness.r", "crate_Body_Roughness.png"},
                     {"metallic.r", "crate_Body_Metallic.png"},
                     {"normal opengl", "crate_Body_Normal.png"}}));
    EXPECT_EQ(use_of("crate_Body_OcclusionRoughnessMetallic.png"), "roughness.g + metallic.b + ao.r");
    EXPECT_EQ(use_of("crate_occlusion_roughness_metallic.png"), "roughness.g + metallic.b + ao.r");
}

TEST(MapNaming, knows_megascans) {
    EXPECT_EQ(slots_of({"vdcjbhf_4K_Albedo.jpg", "vdcjbhf_4K_Normal_LOD0.jpg", "vdcjbhf_4K_Normal.jpg",
                        "vdcjbhf_4K_Roughness.jpg", "vdcjbhf_4K_Gloss.jpg", "vdcjbhf_4K_AO.jpg",
                        "vdcjbhf_4K_Cavity.jpg", "vdcjbhf_4K_Displacement.exr", "vdcjbhf_4K_Bump.jpg",
                        "vdcjbhf_4K_Metallic.jpg", "vdcjbhf_4K_Opacity.jpg", "vdcjbhf_4K_Specular.jpg",
                        "vdcjbhf_Preview.png"}),
              (Slots{{"albedo srgb", "vdcjbhf_4K_Albedo.jpg"},
                     {"normal opengl", "vdcjbhf_4K_Normal.jpg"},
                     {"roughness.r", "vdcjbhf_4K_Roughness.jpg"},
                     {"ao.r", "vdcjbhf_4K_AO.jpg"},
                     {"metallic.r", "vdcjbhf_4K_Metallic.jpg"}}));
    EXPECT_EQ(use_of("vdcjbhf_4K_BaseColor.jpg"), "albedo srgb");
    EXPECT_EQ(use_of("vdcjbhf_4K_Normal_LOD3.jpg"), "normal opengl");
    EXPECT_EQ(use_of("vdcjbhf_2K_Gloss.jpg"), "roughness.r inverted");
}

TEST(MapNaming, knows_poliigon) {
    EXPECT_EQ(use_of("WoodFlooring044_COL_3K.jpg"), "albedo srgb");
    EXPECT_EQ(use_of("WoodFlooring044_NRM_3K.jpg"), "normal opengl");
    EXPECT_EQ(use_of("WoodFlooring044_GLOSS_3K.jpg"), "roughness.r inverted");
}

TEST(MapNaming, knows_blender_node_wrangler) {
    const std::map<std::string, std::vector<const char*>> words{
        {"albedo srgb", {"diffuse", "diff", "albedo", "base", "col", "color", "basecolor"}},
        {"metallic.r", {"metallic", "metalness", "metal", "mtl"}},
        {"normal opengl", {"normal", "nor", "nrm", "nrml", "norm"}},
        {"roughness.r", {"roughness", "rough", "rgh"}},
        {"roughness.r inverted", {"gloss", "glossy", "glossiness"}},
        {"emission srgb", {"emission", "emissive", "emit"}},
        {"ao.r", {"ao", "ambient", "occlusion"}},
        {"-",
         {"bump", "bmp", "displacement", "displace", "disp", "dsp", "height", "heightmap", "alpha",
          "opacity"}},
    };
    for (const auto& [use, list] : words)
        for (const char* word : list) EXPECT_EQ(use_of(std::string("Oak-") + word + ".tif"), use) << word;
}

TEST(MapNaming, knows_armorpaint) {
    const std::map<std::string, std::vector<const char*>> words{
        {"albedo srgb",
         {"albedo", "alb", "basecol", "basecolor", "diffuse", "diff", "base", "bc", "d", "color", "col"}},
        {"normal opengl", {"normal", "normals", "nor", "n", "nrm", "normalgl"}},
        {"ao.r", {"ao", "occlusion", "o", "occ"}},
        {"roughness.r", {"roughness", "rough", "r", "rgh"}},
        {"metallic.r", {"metallic", "metal", "metalness", "m", "met"}},
        {"-", {"displacement", "height", "h", "disp"}},
    };
    for (const auto& [use, list] : words)
        for (const char* word : list) EXPECT_EQ(use_of(std::string("oak_") + word + "_2k.png"), use) << word;
}

TEST(MapNaming, knows_gltf_exporters) {
    EXPECT_EQ(use_of("Default_metalRoughness.jpg"), "roughness.g + metallic.b");
    EXPECT_EQ(use_of("visor_metallicRoughness.png"), "roughness.g + metallic.b");
    EXPECT_EQ(use_of("visor_metallic_roughness.png"), "roughness.g + metallic.b");
    EXPECT_EQ(use_of("visor_metallicroughness.png"), "roughness.g + metallic.b");
    EXPECT_EQ(use_of("visor_orm.png"), "roughness.g + metallic.b + ao.r");
    EXPECT_EQ(use_of("visor_ORM.png"), "roughness.g + metallic.b + ao.r");
    EXPECT_EQ(use_of("visor_occlusionRoughnessMetallic.png"), "roughness.g + metallic.b + ao.r");
}

TEST(MapNaming, knows_packed_maps_of_other_engines) {
    EXPECT_EQ(use_of("rock_RMA.tga"), "roughness.r + metallic.g + ao.b");
    EXPECT_EQ(use_of("rock_MaskMap.png"), "roughness.a inverted + metallic.r + ao.g");
    EXPECT_EQ(use_of("rock_MetallicSmoothness.png"), "roughness.a inverted + metallic.r");
}

TEST(MapNaming, knows_the_course_material_and_prefers_files_of_their_own_to_packed_ones) {
    const std::vector<std::string> helmet{"helmet/AO.jpg",     "helmet/Default_metalRoughness.jpg",
                                          "helmet/albedo.jpg", "helmet/emissive.jpg",
                                          "helmet/helmet.obj", "helmet/metall.jpg",
                                          "helmet/normal.jpg", "helmet/roughness.jpg"};
    EXPECT_EQ(slots_of(helmet), (Slots{{"albedo srgb", "helmet/albedo.jpg"},
                                       {"ao.r", "helmet/AO.jpg"},
                                       {"emission srgb", "helmet/emissive.jpg"},
                                       {"metallic.r", "helmet/metall.jpg"},
                                       {"normal opengl", "helmet/normal.jpg"},
                                       {"roughness.r", "helmet/roughness.jpg"}}));
    EXPECT_EQ(proposed(helmet).name, "helmet");
    const std::string why = reasons_of(helmet, "helmet/Default_metalRoughness.jpg");
    EXPECT_NE(why.find("but 'roughness.jpg' is taken"), std::string::npos) << why;
    EXPECT_NE(reasons_of(helmet, "helmet/helmet.obj").find("Not a picture"), std::string::npos);

    EXPECT_EQ(slots_of({"brick/brick_base_gray.jpg", "brick/brick_normal.jpg", "brick/brick_roughness.jpg"}),
              (Slots{{"albedo srgb", "brick/brick_base_gray.jpg"},
                     {"normal opengl", "brick/brick_normal.jpg"},
                     {"roughness.r", "brick/brick_roughness.jpg"}}));
    EXPECT_EQ(slots_of({"wood/wood_color.jpg", "wood/wood_roughness.jpg"}),
              (Slots{{"albedo srgb", "wood/wood_color.jpg"}, {"roughness.r", "wood/wood_roughness.jpg"}}));
}

TEST(MapNamingTraps, a_role_word_inside_the_name_of_the_set) {
    EXPECT_EQ(use_of("metal_plate_diff_1k.png"), "albedo srgb");
    EXPECT_EQ(use_of("colored_glass_rough.png"), "roughness.r");
    EXPECT_EQ(slots_of({"metal_color.png", "metal_roughness.png", "metal_normal.png"}),
              (Slots{{"albedo srgb", "metal_color.png"},
                     {"roughness.r", "metal_roughness.png"},
                     {"normal opengl", "metal_normal.png"}}));
    EXPECT_EQ(slots_of({"RustyMetalColor.png", "RustyMetalRoughness.png"}),
              (Slots{{"albedo srgb", "RustyMetalColor.png"}, {"roughness.r", "RustyMetalRoughness.png"}}));
    EXPECT_EQ(slots_of({"plaster_rough_diff.png", "plaster_rough_ao.png"}),
              (Slots{{"albedo srgb", "plaster_rough_diff.png"}, {"ao.r", "plaster_rough_ao.png"}}));
    EXPECT_EQ(use_of("old_metal_roughness.png"), "roughness.r")
        << "alone, a metal's roughness is likelier than a packed map";
}

TEST(MapNamingTraps, an_id_that_ends_in_a_role_word) {
    EXPECT_EQ(use_of("tfzvao_4K_Displacement.jpg"), "-");
    EXPECT_EQ(use_of("tfzvao_4K_Albedo.jpg"), "albedo srgb");
    EXPECT_EQ(use_of("tfzvao_4K.jpg"), "-");
    EXPECT_EQ(use_of("chaos.png"), "-");
}

TEST(MapNamingTraps, directx_normals_are_flagged_and_opengl_ones_preferred) {
    for (const char* file :
         {"rock_nor_dx_2k.png", "rock_nor_dx_.png", "Rock_NormalDX.png", "rock-normal-directx.png",
          "rock_DirectX_Normal.png", "rock_normal_DX.png", "rock_normaldx.png", "rock_Normal_DirectX_4K.png"})
        EXPECT_EQ(use_of(file), "normal directx") << file;
    for (const char* file : {"rock_nor_gl_2k.png", "Rock_NormalGL.png", "rock-normal-opengl.png",
                             "rock_OpenGL_Normal.png", "rock_n.png"})
        EXPECT_EQ(use_of(file), "normal opengl") << file;
    const std::vector<std::string> both{"rock_nor_dx_2k.png", "rock_nor_gl_2k.png"};
    EXPECT_EQ(slots_of(both), (Slots{{"normal opengl", "rock_nor_gl_2k.png"}}));
    EXPECT_NE(reasons_of(both, both[1]).find("preferred to 'rock_nor_dx_2k.png': OpenGL"), std::string::npos);
    EXPECT_NE(reasons_of(both, both[0]).find("but 'rock_nor_gl_2k.png' is taken: OpenGL"), std::string::npos);
    EXPECT_NE(reasons_of({both[0]}, both[0]).find("green is flipped"), std::string::npos);
    const auto unstated = proposed({"rock_normal.png"}).rows;
    EXPECT_EQ(unstated[0].confidence, Confidence::Likely);
    EXPECT_NE(unstated[0].reason.find("OpenGL is assumed"), std::string::npos);
}

TEST(MapNamingTraps, resolution_format_and_detail_are_no_part_of_a_name) {
    for (const char* file :
         {"oak_2k_rough.png", "oak_rough-1K.png", "oak_rough_4K-PNG.png", "oak_rough_2048x2048.png",
          "oak_rough_8192.png", "oak_rough_16bit.png", "oak_rough_LOD1.png", "oak_rough_Tex.png",
          "oak-ROUGH-map.png", "oak.rough.1001.exr"})
        EXPECT_EQ(use_of(file), "roughness.r") << file;
    for (const char* file : {"oak_r_2k.png", "oak_r_4K-PNG.png", "T_Oak_R.tga"})
        EXPECT_EQ(use_of(file), "roughness.r") << file;
    for (const char* file : {"r_oak.png", "oakr.png", "oak_r_old.png", "rR.png"})
        EXPECT_EQ(use_of(file), "-") << file;
}

TEST(MapNamingTraps, case_hyphens_humps_and_folders_do_not_matter) {
    for (const char* file :
         {"OAK_BASECOLOR.PNG", "oakBaseColor.png", "oak-base-color.Jpg", "Oak Base Color.tiff",
          "C:\\maps\\metal\\oak_BaseColor.png", "/roughness/metal/oak_baseColorMap.png",
          "größe/Eiche_BaseColor.png", "木_Albedo.png"})
        EXPECT_EQ(use_of(file), "albedo srgb") << file;
}

TEST(MapNamingTraps, emissive_colour_is_emission_and_float_colour_is_linear) {
    EXPECT_EQ(use_of("lamp_EmissiveColor.png"), "emission srgb");
    EXPECT_EQ(use_of("lamp_emission_color.exr"), "emission linear");
    EXPECT_EQ(use_of("oak_color.exr"), "albedo linear");
    EXPECT_EQ(use_of("oak_color_linear.png"), "albedo linear");
    EXPECT_EQ(use_of("oak_color_sRGB.png"), "albedo srgb");
}

TEST(MapNamingTraps, the_vendors_preview_picture_carries_the_name_of_the_set) {
    const std::vector<std::string> set{"Metal014.png", "Metal014_2K_Color.png", "Metal014_2K_Roughness.png"};
    EXPECT_EQ(use_of(set, "Metal014.png"), "-");
    EXPECT_NE(reasons_of(set, "Metal014.png").find("preview"), std::string::npos);
    const std::vector<std::string> plain{"oak.png", "oak_normal.png", "oak_roughness.png"};
    EXPECT_EQ(use_of(plain, "oak.png"), "albedo srgb") << "in a set without a colour map it is the colour";
    EXPECT_EQ(proposed(plain).name, "oak");
}

TEST(MapNamingTraps, a_picture_that_says_nothing_is_colour_only_when_it_comes_alone) {
    const auto alone = proposed({"IMG_20240101.jpg"}).rows;
    EXPECT_EQ(alone[0].slot, MapSlot::Albedo);
    EXPECT_EQ(alone[0].confidence, Confidence::Guess);
    EXPECT_EQ(use_of({"IMG_1.jpg", "IMG_2.jpg"}, "IMG_1.jpg"), "-");
    EXPECT_NE(reasons_of({"IMG_1.jpg", "IMG_2.jpg"}, "IMG_1.jpg").find("choose a slot"), std::string::npos);
}

TEST(MapNamingRivals, the_better_file_wins_and_both_say_why) {
    const struct {
        const char *winner, *loser, *why;
    } cases[] = {
        {"oak_rough_4k.png", "oak_rough_1k.png", "more pixels"},
        {"oak_rough.png", "oak_gloss.png", "no inversion"},
        {"oak_albedo.png", "oak_diffuse.png", "more exact"},
        {"oak_color.png", "oak_base.png", "more exact"},
        {"oak_rough.png", "oak_rough.jpg", "without loss"},
        {"oak_Normal.png", "oak_Normal_LOD2.png", "finer level"},
        {"oak_rough.1001.png", "oak_rough.1002.png", "first UDIM tile"},
        {"oak_rough.png", "oak_r.png", "clearer"},
        {"oak_roughness.png", "oak_orm.png", "of its own"},
        {"a_oak_rough.png", "b_oak_rough.png", "alphabet"},
    };
    for (const auto& [winner, loser, why] : cases)
        for (const std::vector<std::string>& files :
             {std::vector<std::string>{winner, loser}, {loser, winner}}) {
            const auto rows = proposed(files).rows;
            const auto slot = *rows[0].fits;
            const auto row = std::find_if(rows.begin(), rows.end(), [&](const ImportRow& r) {
                return r.slot == MapSlot::Roughness || r.slot == slot;
            });
            EXPECT_EQ(row->file, winner);
            EXPECT_NE(reasons_of(files, winner).find(why), std::string::npos) << reasons_of(files, winner);
            EXPECT_NE(reasons_of(files, loser).find(why), std::string::npos) << reasons_of(files, loser);
        }
}

TEST(MapNamingRivals, the_fuller_set_wins_as_a_whole) {
    EXPECT_EQ(slots_of({"ash_rough.png", "oak_col.png", "oak_nor.png", "oak_rough.png"}),
              (Slots{{"albedo srgb", "oak_col.png"},
                     {"normal opengl", "oak_nor.png"},
                     {"roughness.r", "oak_rough.png"}}));
    EXPECT_EQ(slots_of({"a/x_rough.png", "b/x_col.png", "b/x_rough.png"}),
              (Slots{{"albedo srgb", "b/x_col.png"}, {"roughness.r", "b/x_rough.png"}}));
}

TEST(MapNamingRivals, the_same_file_twice_and_no_file_at_all_are_no_problem) {
    EXPECT_EQ(slots_of({"oak_col.png", "oak_col.png"}), (Slots{{"albedo srgb", "oak_col.png"}}));
    EXPECT_TRUE(proposed({}).rows.empty());
    EXPECT_TRUE(proposed({"", ".", "/", ".png", "..", "___.png", "a/"}).rows.size() >= 7u);
}

TEST(MapNaming, every_row_has_a_reason_that_is_one_sentence) {
    const auto rows = proposed({"oak_col.png", "oak_diff.png", "oak_orm.png", "oak_n.png", "oak_h.png",
                                "oak.png", "notes.txt", "x.png"})
                          .rows;
    for (const ImportRow& row : rows) {
        EXPECT_TRUE(row.reason.ends_with('.')) << row.reason;
        EXPECT_EQ(row.reason.find(".."), std::string::npos) << row.reason;
        EXPECT_EQ(row.slot.has_value() && row.confidence == Confidence::None, false);
    }
}

TEST(MapNaming, a_thousand_files_take_no_time) {
    std::vector<std::string> files;
    for (int i = 0; i < 1000; ++i) files.push_back("set" + std::to_string(i) + "_metal_roughness_2k.png");
    EXPECT_EQ(slots_of(files).size(), 1u);
    EXPECT_NE(proposed(files).rows[0].reason.find("; and to 997 more."), std::string::npos);
}

TEST(ImportSheet, the_artist_moves_a_row_and_the_slot_is_taken_only_once) {
    ImportProposal proposal = proposed({"oak_rough.png", "oak_gloss.png", "oak_col.png", "strange.png"});
    const auto row = [&](const char* file) {
        return static_cast<std::size_t>(std::find_if(proposal.rows.begin(), proposal.rows.end(),
                                                     [&](const ImportRow& r) { return r.file == file; }) -
                                        proposal.rows.begin());
    };
    choose_slot(proposal, row("oak_gloss.png"), MapSlot::Roughness);
    EXPECT_FALSE(proposal.rows[row("oak_rough.png")].slot);
    EXPECT_EQ(proposal.rows[row("oak_gloss.png")].slot, MapSlot::Roughness);
    choose_slot(proposal, row("strange.png"), MapSlot::Metallic);
    choose_slot(proposal, row("oak_col.png"), std::nullopt);
    choose_slot(proposal, row("oak_rough.png"), std::nullopt);
    const Material material = apply_import({}, proposal);
    EXPECT_EQ(material.roughness, (ScalarSlot{1.0f, "oak_gloss.png", Channel::R, true}));
    EXPECT_EQ(material.metallic, (ScalarSlot{1.0f, "strange.png", Channel::R, false}));
    EXPECT_EQ(material.albedo, Material{}.albedo);
}

TEST(ImportSheet, applying_a_set_lets_the_maps_alone_decide) {
    const Material material =
        apply_import({}, proposed({"x/oak_col.png", "x/oak_orm.png", "x/oak_nor_dx.png", "x/oak_emit.exr"}));
    Material expected;
    expected.name = "oak";
    expected.albedo = {glm::vec3(1.0f), "x/oak_col.png", ColorSpace::Srgb};
    expected.roughness = {1.0f, "x/oak_orm.png", Channel::G, false};
    expected.metallic = {1.0f, "x/oak_orm.png", Channel::B, false};
    expected.ao = {1.0f, "x/oak_orm.png", Channel::R, false};
    expected.normal = {1.0f, "x/oak_nor_dx.png", NormalConvention::DirectX};
    expected.emission = {glm::vec3(1.0f), "x/oak_emit.exr", ColorSpace::Linear};
    EXPECT_EQ(material, expected);
}

TEST(ImportSheet, a_set_clears_the_maps_of_the_set_before_but_no_value_set_by_hand) {
    Material before;
    before.name = "My wall";
    before.metallic = {1.0f, "old_metal.png", Channel::B, true};
    before.emission.value = {2, 0, 0};
    before.uv.scale = {3, 3};
    ImportProposal proposal = proposed({"oak_col.png", "oak_rough.png"});
    EXPECT_TRUE(proposal.clear_other_maps);
    Material after = apply_import(before, proposal);
    EXPECT_EQ(after.metallic, Material{}.metallic);
    EXPECT_EQ(after.emission, before.emission);
    EXPECT_EQ(after.uv, before.uv);
    EXPECT_EQ(after.name, "My wall");
    proposal.clear_other_maps = false;
    EXPECT_EQ(apply_import(before, proposal).metallic, before.metallic);
    EXPECT_FALSE(proposed({"oak_rough.png"}).clear_other_maps) << "one map replaces one map";
}

TEST(ImportSheet, wood_dropped_on_gold_is_not_a_metal) {
    Material gold;
    gold.metallic.value = 1.0f;
    EXPECT_EQ(apply_import(gold, proposed({"oak_col.png", "oak_rough.png"})).metallic.value, 0.0f);
    EXPECT_EQ(apply_import(gold, proposed({"gold_nor.png", "gold_rough.png"})).metallic.value, 1.0f)
        << "finer relief for the same metal";
    EXPECT_EQ(apply_import(gold, proposed({"gold_col.png"})).metallic.value, 1.0f)
        << "one map replaces one map";
}

TEST(MapWords, names_are_taken_apart_at_separators_humps_and_digits) {
    const auto words = [](const char* name) {
        std::string text;
        for (const NameToken& token : tokenize(name))
            text += (token.noise ? "(" + token.word + ")" : token.word) + " ";
        return text;
    };
    EXPECT_EQ(words("Metal014_4K-PNG_NormalGL"), "metal 014 (4k) (png) normal gl ");
    EXPECT_EQ(words("vd4Xfao_2048x2048_BaseColor_LOD0"), "vd 4 xfao (2048) (x) (2048) base color (lod) (0) ");
    EXPECT_EQ(words("ABCDef ghi"), "abc def ghi ");
    EXPECT_EQ(words("__ "), "");
    EXPECT_EQ(words("größeÄ"), "größeÄ ") << "other alphabets stay whole";
}

}  // namespace patina
