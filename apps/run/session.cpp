#include "apps/run/session.h"

#include <thread>

namespace apps {

int thread_count(const Session& session) {
  const int cores = static_cast<int>(std::thread::hardware_concurrency());
  return session.threads > 0 ? session.threads : std::max(1, cores);
}

}  // namespace apps
