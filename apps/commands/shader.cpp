#include <fmt/format.h>

#include "apps/commands/commands.h"
#include "apps/pictures/bilinear_shader.h"
#include "apps/run/run_record.h"

namespace apps {

Exit print_shader(const ShaderCommand& command, const Session& session) {
  spectra::BilinearSet set = spectra::bilinear_set(command.set);
  if (command.alpha) set = spectra::with_alpha(set, Eigen::Vector3d(command.alpha->data()));
  const BilinearShader shader = bilinear_shader(set);
  if (session.json) {
    fmt::print("{}\n", Json{{"set", set.name},
                            {"instructions", shader.instructions},
                            {"over_classical", shader.instructions - 1},
                            {"glsl", shader.glsl}}
                           .dump(2));
  } else {
    fmt::print("{}", shader.glsl);
  }
  return Exit::done;
}

}  // namespace apps
