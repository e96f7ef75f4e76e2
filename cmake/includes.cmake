# Each folder of src may include only itself and the folders that are named here; cmake -P includes.cmake SOURCE_DIR
# fails with the file and line of every other include. The build runs it, so an effect that includes the scene or the
# renderer does not build.
cmake_minimum_required(VERSION 3.22)
set(base "")
set(scene base)
set(noise base)
set(compare base)
set(reference base scene compare)
set(shaders base effects noise)
set(gpu base)
set(reflection base gpu)
set(effects base gpu shaders)
set(lighting base gpu effects)
set(api base gpu lighting noise)
set(device base gpu)
set(renderer base gpu lighting device scene noise shaders)
set(capture ${renderer} effects renderer)
set(job ${capture} capture reference)
set(measure ${job} job compare)
set(dataset ${job} job)
set(cli ${measure} measure dataset)
set(view ${cli} cli reflection)
set(folders base scene noise compare reference shaders gpu reflection effects lighting api device renderer capture job dataset measure cli view)

# How effects feed one another is known to src/lighting alone. The renderer may include, of the effects, only:
set(renderer_headers
    effects/view.h effects/lamps.h effects/planar/planar.h effects/probe/probes.h # parameters, shared with shaders
    effects/gbuffer/gbuffer.h effects/shadow/shadow.h effects/shadow/lamp_shadow.h # what it draws
    effects/cube_map/cube_map.h effects/environment/environment_light.h effects/lobe/rays.h
    effects/lobe/generate_rays.h effects/lobe/ray_tiles.h effects/lobe/trace_screen.h
    effects/probe/answer_probes.h effects/radiance_cache/radiance_cache.h
    effects/ambient_occlusion/ambient_occlusion.h # its own sources of rays: probes, the traced scene, glass
    effects/exposure/exposure.h effects/tonemap/tone_map_image.h) # on the host, for images of the reference

foreach(folder IN LISTS folders)
    file(GLOB_RECURSE files ${SOURCE_DIR}/src/${folder}/*.h ${SOURCE_DIR}/src/${folder}/*.cpp
        ${SOURCE_DIR}/src/${folder}/*.glsl ${SOURCE_DIR}/src/${folder}/*.comp ${SOURCE_DIR}/src/${folder}/*.vert
        ${SOURCE_DIR}/src/${folder}/*.frag)
    foreach(file IN LISTS files)
        file(STRINGS ${file} lines REGEX "^#include \"[a-z_]+/")
        foreach(line IN LISTS lines)
            string(REGEX REPLACE "^#include \"([a-z_]+)/.*" "\\1" used "${line}")
            string(REGEX REPLACE "^#include \"([^\"]*)\".*" "\\1" header "${line}")
            # Functions in GLSL have no rules.
            if(header IN_LIST ${folder}_headers OR (folder STREQUAL "renderer" AND header MATCHES "^effects/.*\\.glsl$"))
                continue()
            endif()
            if(used IN_LIST folders AND NOT used STREQUAL folder AND NOT used IN_LIST ${folder})
                message(SEND_ERROR "${file}: ${line}\nsrc/${folder} may include only itself and: ${${folder}}")
            endif()
        endforeach()
    endforeach()
endforeach()
