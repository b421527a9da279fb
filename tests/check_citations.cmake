cmake_minimum_required(VERSION 3.25)

# Each source cited by key, as in [Neumann2004], is listed in REFERENCES.bib, and each source listed
# there is cited. Run from the repository's root.
file(READ REFERENCES.bib bibliography)
string(REGEX MATCHALL "@[a-z]+{[A-Za-z0-9]+," entries "${bibliography}")
list(TRANSFORM entries REPLACE "@[a-z]+{([A-Za-z0-9]+)," "\\1" OUTPUT_VARIABLE known)

file(GLOB_RECURSE files RELATIVE ${CMAKE_SOURCE_DIR}
     appearance/*.h appearance/*.cpp scenes/*.h scenes/*.cpp solver/*.h solver/*.cpp
     paints/*.h paints/*.cpp apps/*.h apps/*.cpp tests/*.h tests/*.cpp
     appearance/*.md scenes/*.md solver/*.md paints/*.md apps/*.md tests/*.md)
set(cited "")
foreach(file README.md ${files})
  file(READ ${file} text)
  string(REGEX MATCHALL "[[][A-Z][A-Za-z]+[0-9][0-9]+[]]" citations "${text}")
  string(REGEX MATCHALL "[A-Z][A-Za-z]+[0-9]+" keys "${citations}")
  foreach(key IN LISTS keys)
    if(NOT key IN_LIST known)
      message(SEND_ERROR "${file}: [${key}] is not in REFERENCES.bib")
    endif()
  endforeach()
  list(APPEND cited ${keys})
endforeach()
foreach(key IN LISTS known)
  if(NOT key IN_LIST cited)
    message(SEND_ERROR "REFERENCES.bib: ${key} is cited nowhere")
  endif()
endforeach()
