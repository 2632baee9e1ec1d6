# docker build -t monarch_flight .    docker run --rm -v "$PWD:/work" monarch_flight fly fluid:=quasi_steady flaps:=2
FROM debian:bookworm AS built
COPY . /source
RUN apt-get update && /source/scripts/package && mv /source/build_package/monarch-flight_*.deb /

FROM debian:bookworm
COPY --from=built /monarch-flight_*.deb /
RUN apt-get update && apt-get install -y --no-install-recommends /monarch-flight_*.deb \
    && rm -rf /var/lib/apt/lists/* /monarch-flight_*.deb
WORKDIR /work
ENTRYPOINT ["monarch"]
