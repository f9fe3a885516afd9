# SPDX-License-Identifier: Apache-2.0
# gltfx and its run-time dependencies:
#   docker build --tag gltfx .
#   docker run --rm --volume "$PWD:/assets:ro" gltfx validate .
FROM debian:12-slim AS build
COPY . /gltfx
WORKDIR /gltfx
RUN tools/deb && rm -rf /var/lib/apt/lists/*

FROM debian:12-slim
COPY --from=build /gltfx/build/deb/gltfx_*.deb /gltfx/build/deb/gltfx-openimageio_*.deb /tmp/
RUN apt-get update \
    && apt-get install --yes --no-install-recommends /tmp/gltfx*.deb \
    && rm -rf /tmp/gltfx*.deb /var/lib/apt/lists/* \
    && useradd --create-home gltfx
USER gltfx
WORKDIR /assets
ENTRYPOINT ["gltfx"]
CMD ["--help"]
