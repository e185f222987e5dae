# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
"""The logs that tools/golden.sh replays: name, how the log is made, how it is replayed. Cases with
the same log share a drive of the fleet, and those with the same way of replaying a configuration;
each is called as the first of them."""
import dataclasses


@dataclasses.dataclass(frozen=True)
class Case:
    name: str
    sim: tuple = ()       # arguments of lio-sim; empty for a real log
    real: str = ""        # a file of the shared data
    config: str = ""      # configuration for a real log
    replay: tuple = ()    # further arguments of lio-replay
    lag: int = 0          # messages by which each match is late, as on a busy daemon
    threads: int = 1

    @property
    def log(self):
        return self.sim, self.real, self.config

    @property
    def way(self):
        lag = ("--match-lag", str(self.lag)) if self.lag else ()
        return (*self.replay, *lag), self.threads


def lio_sim(scenario, lidar, imu, duration_s, *words):
    return ("--scenario", scenario, "--lidar", lidar, "--imu", imu, "--duration", str(duration_s),
            *words)


def faulty(scenario, imu, *faults):
    words = [word for fault in faults for word in ("--fault", fault)]
    return lio_sim(scenario, "vlp16", imu, 14, *words)


XSENS, CONSUMER = "xsens_mti10", "consumer_mems"
LIDAR_ONLY = ("--set", "pipeline.use_imu=false")
LOAM, GICP = (("--set", f"pipeline.method={method}") for method in ("loam", "gicp"))

STREET = lio_sim("street", "vlp16", XSENS, 14)
GYRO_DEAD = faulty("hall", XSENS, "imu_dead:start=8")
STREET_CLOCKS_SET = faulty("street", XSENS, "stamp_jump:channel=both,start=6,offset=1.2,duration=2")
IMU_COMES_LATE = faulty("street", XSENS, "imu_gap:start=0,duration=6")
BOTH_GAP = faulty("street", XSENS, "imu_gap:start=7,duration=2", "lidar_gap:start=7,duration=2")
CAMPUS = lio_sim("campus", "vlp16", CONSUMER, 14)
CAMPUS_TURNED_MOVING = lio_sim("campus", "vlp16", CONSUMER, 12, "--imu-variant", "turned",
                               "--moving-start")

CASES = (
    # every scenario, every lidar, both inertial units
    Case("street-vlp16", STREET),
    Case("street-hdl64e", lio_sim("street", "hdl64e", XSENS, 10)),
    Case("loop-hdl32e", lio_sim("loop", "hdl32e", XSENS, 10)),
    Case("suburb-vlp16", lio_sim("suburb", "vlp16", CONSUMER, 14)),
    Case("tunnel-vlp16", lio_sim("tunnel", "vlp16", XSENS, 16)),
    Case("motorway-os1", lio_sim("motorway", "os1_64", CONSUMER, 10)),
    Case("garage-vlp16", lio_sim("garage", "vlp16", CONSUMER, 14)),
    Case("campus-vlp16", CAMPUS),
    Case("hall-os1", lio_sim("hall", "os1_64", XSENS, 12)),
    # 30 s, not 10 to 20: by then the walk is on the second storey, which looks like the first.
    Case("office-vlp16", lio_sim("office", "vlp16", XSENS, 30)),
    Case("mine-vlp16", lio_sim("mine", "vlp16", CONSUMER, 14)),
    Case("hedgerows-vlp16", lio_sim("hedgerows", "vlp16", XSENS, 14)),
    Case("warehouse-vlp16", lio_sim("warehouse", "vlp16", XSENS, 14)),
    Case("parked-vlp16", lio_sim("parked", "vlp16", XSENS, 12)),
    # starts in motion
    Case("moving-street", lio_sim("street", "vlp16", CONSUMER, 12, "--moving-start")),
    Case("moving-motorway", lio_sim("motorway", "hdl32e", XSENS, 10, "--moving-start")),
    Case("moving-campus", lio_sim("campus", "vlp16", XSENS, 12, "--moving-start")),
    # methods
    Case("loam-street", STREET, replay=LOAM),
    Case("gicp-street", STREET, replay=GICP),
    Case("threads-street", STREET, threads=3),
    # lidar-only
    Case("lidar-only-street", STREET, replay=LIDAR_ONLY),
    Case("lidar-only-campus-gap", faulty("campus", CONSUMER, "lidar_gap:start=6,duration=2"),
         replay=LIDAR_ONLY),
    Case("lidar-only-gicp", CAMPUS, replay=(*LIDAR_ONLY, *GICP)),
    Case("lidar-only-loam", CAMPUS, replay=(*LIDAR_ONLY, *LOAM)),
    Case("lidar-only-clock-back",
         faulty("street", XSENS, "stamp_jump:channel=lidar,start=6,offset=-2,duration=20"),
         replay=LIDAR_ONLY),
    Case("imu-comes-late", IMU_COMES_LATE),
    Case("imu-never-comes", faulty("campus", CONSUMER, "imu_gap:start=0,duration=60")),
    # faults
    Case("imu-gap", faulty("campus", CONSUMER, "imu_gap:start=6,duration=0.7")),
    Case("imu-gap-long", faulty("street", XSENS, "imu_gap:start=7,duration=3.5")),
    Case("both-gap", BOTH_GAP),
    Case("lidar-gap", faulty("suburb", XSENS, "lidar_gap:start=6,duration=3")),
    Case("drop", faulty("street", CONSUMER, "drop:ratio=0.2")),
    Case("duplicate-reorder", faulty("campus", XSENS, "duplicate:ratio=0.1", "reorder:ratio=0.1")),
    Case("chunk-loss", faulty("garage", XSENS, "chunk_loss:ratio=0.15")),
    Case("clocks-set-forth", STREET_CLOCKS_SET),
    Case("clocks-set-back", faulty("suburb", XSENS,
                                   "stamp_jump:channel=both,start=6,offset=-0.6,duration=3")),
    Case("imu-clock-steps", faulty("street", CONSUMER,
                                   "stamp_jump:channel=imu,start=6,offset=0.5,duration=3")),
    Case("lidar-clock-steps", faulty("street", XSENS,
                                     "stamp_jump:channel=lidar,start=6,offset=-0.5,duration=2")),
    Case("clock-offset", faulty("campus", XSENS, "clock_offset:offset=0.02")),
    Case("nan", faulty("street", XSENS, "nan:ratio=0.05")),
    Case("gyro-saturation", faulty("hall", XSENS, "gyro_saturation:limit=0.4,start=5,duration=4")),
    Case("gyro-dead", GYRO_DEAD),
    Case("accelerometer-off", faulty("hall", XSENS, "imu_offset:start=8,gyro=0,accel=1")),
    Case("shaking", faulty("street", XSENS, "shaking:start=6,duration=4")),
    Case("empty-sparse", faulty("suburb", XSENS, "empty_scan:start=5,duration=1",
                                "sparse_scan:start=8,duration=2")),
    Case("dust", faulty("garage", CONSUMER, "dust:start=6,duration=4")),
    Case("wrong-extrinsic", faulty("loop", XSENS, "wrong_extrinsic:yaw_deg=3,x=0.3")),
    Case("lost-in-hall", faulty("hall", CONSUMER, "lidar_gap:start=5,duration=3",
                                "imu_gap:start=5.5,duration=0.6")),
    # other units and axes than expected
    Case("imu-in-g-and-deg", lio_sim("street", "vlp16", XSENS, 12, "--imu-variant", "in-g-and-deg")),
    Case("imu-z-down", lio_sim("campus", "vlp16", XSENS, 14, "--imu-variant", "z-down")),
    Case("imu-turned", lio_sim("loop", "vlp16", XSENS, 16, "--imu-variant", "turned")),
    Case("imu-deg-moving", lio_sim("street", "vlp16", XSENS, 12, "--imu-variant", "in-deg",
                                   "--moving-start")),
    Case("imu-turned-moving", CAMPUS_TURNED_MOVING),
    Case("imu-refused", lio_sim("street", "vlp16", XSENS, 12, "--imu-variant", "in-deg"),
         replay=("--set", "rig.imu.units=si")),
    Case("imu-gravity-removed", lio_sim("street", "vlp16", XSENS, 12, "--imu-variant",
                                        "gravity-removed")),
    # matches that come late, as on a daemon under load
    Case("lag-street", STREET, lag=9),
    Case("lag-clocks-set", STREET_CLOCKS_SET, lag=17),
    Case("lag-campus", CAMPUS, lag=14),
    Case("lag-both-gap", BOTH_GAP, lag=13),
    Case("lag-gyro-dead", GYRO_DEAD, lag=12),
    Case("lag-imu-comes-late", IMU_COMES_LATE, lag=11),
    Case("lag-imu-turned-moving", CAMPUS_TURNED_MOVING, lag=8),
    # real and realistic recordings
    Case("kitti", real="kitti_raw_0005_first80.tar.xz", config="config/kitti_raw.yaml"),
    Case("kitti-lidar-only", real="kitti_raw_0005_first80.tar.xz", config="config/kitti_raw.yaml",
         replay=LIDAR_ONLY),
    Case("ulhk", real="ulhk_sample.bag.xz", config="test/integration/rigs/ulhk_sample.yaml"),
    Case("ulhk-notime", real="ulhk_sample_notime.bag.xz",
         config="test/integration/rigs/ulhk_sample_notime.yaml"),
)
