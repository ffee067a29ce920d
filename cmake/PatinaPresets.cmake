# The shipped presets as the program finds them: JSON and schema copied, maps computed, below share/patina/presets of the
# build folder. One command a set of maps, so that they run side by side and only what changed is made again.
include(GNUInstallDirs)
set(preset_folder ${CMAKE_BINARY_DIR}/share/patina/presets)

add_executable(patina_make_maps make_maps.cpp)
target_link_libraries(patina_make_maps PRIVATE patina_map_recipes patina_image_io patina_flags)

set(preset_outputs "")
foreach(recipe brushed-steel worn-paint rusted-iron hammered-copper glazed-tiles terrazzo woven-cloth oak-planks cooling-lava)
    set(stamp ${CMAKE_CURRENT_BINARY_DIR}/maps/${recipe}.stamp)
    add_custom_command(OUTPUT ${stamp}
        COMMAND ${CMAKE_COMMAND} -E make_directory ${preset_folder}/maps ${CMAKE_CURRENT_BINARY_DIR}/maps
        COMMAND patina_make_maps ${preset_folder}/maps ${recipe}
        COMMAND ${CMAKE_COMMAND} -E touch ${stamp}
        DEPENDS patina_make_maps
        COMMENT "Making the maps of ${recipe}"
        VERBATIM)
    list(APPEND preset_outputs ${stamp})
endforeach()

file(GLOB preset_files CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/materials/presets/*.json)
foreach(file IN LISTS preset_files)
    get_filename_component(name ${file} NAME)
    add_custom_command(OUTPUT ${preset_folder}/${name}
        COMMAND ${CMAKE_COMMAND} -E make_directory ${preset_folder}
        COMMAND ${CMAKE_COMMAND} -E copy ${file} ${preset_folder}/${name}
        DEPENDS ${file}
        VERBATIM)
    list(APPEND preset_outputs ${preset_folder}/${name})
endforeach()

add_custom_target(patina_presets DEPENDS ${preset_outputs})
add_dependencies(patina patina_presets)
install(DIRECTORY ${preset_folder}/ DESTINATION ${CMAKE_INSTALL_DATADIR}/patina/presets)
