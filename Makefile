# The two commands of README.md and those around them. CMake does the work:
# `cmake --preset dev` and the other presets serve for daily development.

RUNGPROOF := build/release/rungproof

.PHONY: all demo test install deb clean

all: $(RUNGPROOF)

.PHONY: $(RUNGPROOF)
$(RUNGPROOF):
	scripts/deps
	cmake --preset release $(CMAKE_OPTIONS)
	cmake --build --preset release --target rungproof

demo: all
	scripts/demo $(RUNGPROOF)

test: all
	cmake --build --preset release
	ctest --preset release

install: all
	cmake --install build/release $(if $(PREFIX),--prefix $(PREFIX))

deb: all
	cd build/release && cpack -G DEB

clean:
	rm -rf build
