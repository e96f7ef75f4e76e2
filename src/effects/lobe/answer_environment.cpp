// Records the environment as the last ray source.
#include "effects/lobe/answer_environment.h"

#include "effects/ambient_occlusion/ambient_occlusion.h"

namespace reflet {

void answerEnvironment(gpu::PassList& f, Rays& rays, const EnvironmentLight& environment,
                       const EnvironmentSettings& settings) {
    gpu::ComputePass pass = f.compute("answer_environment", "answer_environment.comp");
    bindEnvironment(pass, environment);
    bindEnvironmentLobes(pass, f.context(), environment);
    bindAmbientOcclusion(f, pass, rays.from.ambientOcclusion, rays.from.scale)
        .constant("lobe", rays.lobe)
        .constant("environmentLights", settings.enabled)
        .constant("spreads", rays.spreads ? 1U : 0U)
        .read("material", rays.from.g.material)
        .read("direction", rays.direction)
        .read("waiting", rays.waiting)
        .write("answer", rays.answer)
        .write("source", rays.source)
        .params(AnswerEnvironmentParams{settings}, "environmentAnswer")
        .dispatchIndirect(rays.waiting, 0);
    rays.waiting = {};
}

}  // namespace reflet
