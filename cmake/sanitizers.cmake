# One switch for every target: a sanitizer only helps when the whole program carries it.
if(DUSKLINE_SANITIZE)
  add_compile_options(-fsanitize=${DUSKLINE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${DUSKLINE_SANITIZE})
  # With the sanitizers' checks in between, GCC 12 no longer sees that the standard library sets what it reads.
  add_compile_options(-Wno-maybe-uninitialized)
endif()
