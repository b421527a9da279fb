cmake_minimum_required(VERSION 3.25)

# The architecture as a test: which folders each folder may include, and which libraries are seen
# where. Run from the repository's root.
set(appearance/spectra_may "appearance/spectra")
set(scenes_may             "appearance/spectra|scenes")
set(solver_may             "appearance/spectra|scenes|solver")
set(appearance_may         "appearance")
set(paints_may             "appearance|paints")
set(apps_may               "appearance|scenes|solver|paints|apps")

# Headers of libraries that only one folder may know.
set(only_in_scenes "OpenMesh/")
set(only_in_solver "embree3/|tbb/|oneapi/|hwy/")
set(only_in_apps   "CLI/|openssl/|OpenEXR/|Imath/")

foreach(part appearance/spectra scenes solver appearance paints apps)
  file(GLOB_RECURSE files RELATIVE ${CMAKE_SOURCE_DIR} ${part}/*.h ${part}/*.cpp)
  foreach(file IN LISTS files)
    file(STRINGS ${file} lines REGEX "^ *#include")
    foreach(line IN LISTS lines)
      if(line MATCHES "#include \"" AND NOT line MATCHES "\"(${${part}_may})/")
        message(SEND_ERROR "${file}: ${line}\n${part}/ may include only ${${part}_may}")
      endif()
      foreach(owner scenes solver apps)
        if(NOT part STREQUAL owner AND line MATCHES "#include <(${only_in_${owner}})")
          message(SEND_ERROR "${file}: ${line}\nonly ${owner}/ may include this")
        endif()
      endforeach()
    endforeach()
  endforeach()
endforeach()
