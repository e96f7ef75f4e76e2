// A host's matrices, surfaces and conventions as Reflet's.
#pragma once

#include "api/frame.h"
#include "lighting/host_images.h"

#include "reflet/reflet.h"

#include <functional>

namespace reflet::api {

/// Throws Failure for matrices that are no camera. size, before: of this and the last frame.
ViewParams viewParams(const RefletFrameInfo& info, RefletDepthKind depthKind, uvec2 size, uvec2 before);

/// view: of viewParams.
ImportParams importParams(const RefletFrameInfo& info, const RefletGBuffer& g, const ViewParams& view);

/// Throws Failure for wrong images and kinds. read: what the library reads of each image.
void checkGBuffer(const RefletGBuffer& g, const Rectangle& read);

/// adopt: makes an image of the host known to the recorder.
HostSurfaces hostSurfaces(const RefletGBuffer& g, const std::function<gpu::Image(const RefletImage&)>& adopt);

}  // namespace reflet::api
