// Records the environment as a source of answers.
#include "render/bounce/answer_environment.h"

namespace reflet {

void answerEnvironment(gpu::Frame& f, Rays& rays, const GBuffer& g, const vec3& radiance,
                       const EnvironmentSettings& settings) {
    f.compute("answer_environment", "answer_environment.comp")
        .constant("lobe", rays.lobe)
        .read("material", g.material)
        .read("waiting", rays.waiting)
        .write("answer", rays.answer)
        .write("source", rays.source)
        .params(AnswerEnvironmentParams{radiance, settings})
        .dispatchIndirect(rays.waiting, 0);
    rays.waiting = {};
}

}  // namespace reflet
