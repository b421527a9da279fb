#include <fmt/format.h>

#include "apps/commands/commands.h"
#include "apps/pictures/bilinear_shader.h"
#include "apps/run/run_record.h"
#include "apps/system/terminal.h"

namespace apps {

Exit print_shader(const ShaderCommand& command, const Session& session) {
  spectra::BilinearSet set = spectra::bilinear_set(command.set);
  if (command.alpha) set = spectra::with_alpha(set, Eigen::Vector3d(command.alpha->data()));
  const BilinearShader shader = bilinear_shader(set);
  if (session.json) {
    const Json data{{"set", set.name},
                    {"instructions", shader.instructions},
                    {"over_classical", shader.instructions - 1},
                    {"glsl", shader.glsl}};
    put(data.dump(2) + "\n");
  } else {
    put(shader.glsl);
  }
  return Exit::done;
}

}  // namespace apps
