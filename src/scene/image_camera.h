// The camera of an image as the header of its file states it.
#pragma once

#include "base/image_camera.h"
#include "scene/scene.h"

namespace reflet {

/// Of a posed view, in the coordinates of the scene's file. size: of the image in pixels.
ImageCamera imageCamera(const View& view, uvec2 size);

}  // namespace reflet
