#include "apps/system/outcome.h"

#include <fmt/format.h>

#include <exception>
#include <filesystem>
#include <new>

#include "appearance/spectra/text/input_error.h"
#include "solver/rooms/room_light.h"

namespace apps {

Outcome guarded(const std::function<Exit()>& job) {
  try {
    return {.exit = job(), .message = ""};
  } catch (const spectra::InputError& error) {
    return {.exit = Exit::invalid_input, .message = error.what()};
  } catch (const solver::TooLarge& error) {
    return {.exit = Exit::invalid_input, .message = error.what()};
  } catch (const spectra::FileError& error) {
    return {.exit = Exit::file_error, .message = error.what()};
  } catch (const std::filesystem::filesystem_error& error) {
    return {.exit = Exit::file_error, .message = error.what()};
  } catch (const std::bad_alloc&) {
    return {.exit = Exit::invalid_input,
            .message = "memory ran out; a larger --patch-m makes a smaller job"};
  } catch (const std::exception& error) {
    return {.exit = Exit::our_bug,
            .message = fmt::format("{} (our bug: please report it with the input)", error.what())};
  } catch (...) {
    return {.exit = Exit::our_bug, .message = "unknown exception (our bug: please report it)"};
  }
}

}  // namespace apps
