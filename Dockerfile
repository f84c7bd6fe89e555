# The program alone, as a Debian package in a small image.
#   docker build --tag rungproof .
#   docker run --rm --volume "$PWD:/work" rungproof check .
FROM debian:12 AS build
COPY . /src
WORKDIR /src
RUN scripts/deps --tool && \
    apt-get install -y --no-install-recommends dpkg-dev file && \
    cmake --preset release -DBUILD_TESTING=OFF && \
    cmake --build --preset release && \
    cpack -G DEB -B /package --config build/release/CPackConfig.cmake

FROM debian:12-slim
COPY --from=build /package/*.deb /package/
# git: for `equiv --git`.
RUN apt-get update && \
    apt-get install -y --no-install-recommends git /package/*.deb && \
    rm -rf /package /var/lib/apt/lists/*
WORKDIR /work
ENTRYPOINT ["rungproof"]
