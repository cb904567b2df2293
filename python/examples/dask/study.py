# A study on a Dask cluster. Here the cluster is two processes on this machine; for several machines, use
# `Client("tcp://scheduler:8786")`.

from distributed import Client

import dashpot

if __name__ == "__main__":
    study = dashpot.Study.from_toml("""
name = "clearance"
observed = ["body_vertical_rms_m_per_s2", "derailment_greatest"]
[[sweep]]
name = "clearance"
case = "straight-180"
duration_s = 0.5
seeds = [1, 2]
vary = [{ parameter = "vertical.mount.clearance_m", values = [0.0, 1e-3, 2e-3] }]
""")
    with Client(n_workers=2, threads_per_worker=1, dashboard_address=None) as client:
        rows = list(client.get_executor().map(study.row, range(len(study))))
    for row in rows:
        print(row["vertical.mount.clearance_m"], row["seed"], row["derailment_greatest"])
    # The rows have the same bits as on one machine.
    assert [row["derailment_greatest"] for row in rows] == study.run()["derailment_greatest"].tolist()
