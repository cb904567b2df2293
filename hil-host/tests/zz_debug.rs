mod reference_common;
use dashpot_hil::reference::Reference;
use reference_common::radau::Radau;
use reference_common::{dampers, motions, nrmse};
#[test]
fn maxwell() {
    let (c,k,w,a)=(120e3,8e6,2.0*std::f64::consts::PI*3.0,1e-3);
    let p = dampers::reduced(c,1e3,k,0.0);
    let (t,x)=motions::sampled(20e3,0.5,|t| a*(w*t).sin());
    let mut r=Reference::new(&p).unwrap();
    // exact for piecewise linear: F' = K(u - F/C)
    let mut f=vec![0.0];
    for i in 1..t.len(){ let dt=t[i]-t[i-1]; let u=(x[i]-x[i-1])/dt; let e=(-k/c*dt).exp(); let p=f[i-1]; f.push(c*u+(p-c*u)*e);}
    let d=r.forces(&t,&x).unwrap();
    println!("diffsol {:e} {:?}", nrmse(&d,&f), r.statistics());
    let d=r.forces_with(&mut Radau::default(),&t,&x).unwrap();
    println!("radau {:e} {:?}", nrmse(&d,&f), r.statistics());
    for i in (0..t.len()).step_by(500) { println!("{} {} {}", t[i], f[i], d[i]); }
}
